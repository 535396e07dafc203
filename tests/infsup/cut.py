"""The lower plate ends within a facet of the upper one, at a fraction e of it. Then beta is about 1.6 e, down to the fraction 0.045.
There the node behind it is removed (D below 1/1000 of the uncovered value)."""
from flatness import number
from judge import near, require

FACETS = 16


def judge(run):
    def beta(e):
        end = (FACETS / 2 + e) / FACETS
        return number(run.again("-lower_dm_plex_box_upper", f"{end!r},0", name=f"e{e}"), "joint")

    whole = beta(0.0)
    require(whole > 1, f"a facet that is not cut: {whole}")
    for e in (0.046, 0.08, 0.16):
        near(f"e = {e}", beta(e), 1.6 * e, relative=0.05)
    near("a node that is removed", beta(0.044), whole, relative=0.01)
