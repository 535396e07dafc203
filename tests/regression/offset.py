"""An offset of the gap by a formula is that of the curve over the facets: it is constant there, and the result that of the constant."""
from judge import near


def judge(run):
    given = run.again("-fit_gap_offset", "-0.02", name="constant")
    for key in ("normal_force", "max_pressure"):
        near(key, run.pair("fit")[key], given.pair("fit")[key], relative=1e-3)  # s gamma^2/16 of the curve
