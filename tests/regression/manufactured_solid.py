"""M3: observed orders of convergence in space; in the long run, tetrahedra and order 1 on finer meshes, too.

Kuhn's tetrahedra are stretched and get to their orders later. With order 1, energy and L2 fall with h^0.84 and h^1.45 between 4 and
8 cells along an edge. Between 8 and 16 they fall with h^0.93 and h^1.76, between 16 and 20 with h^0.97 and h^1.88.
"""
import math

from judge import LONG, require

# (tetrahedra, order): cells along an edge above and below on two meshes, and how near orders are to those that they tend to
LADDER = {(0, 2): ((4, 6), (6, 9), 0.1)}
if LONG:
    LADDER |= {(0, 1): ((8, 12), (16, 24), 0.1), (1, 2): ((8, 12), (10, 15), 0.11), (1, 1): ((16, 24), (20, 30), 0.12)}
DIRECT = ["-ksp_type", "preonly", "-pc_type", "cholesky"]


def errors(run, simplex, order, above, below):
    words = ["-order", str(order)]
    for body, n in (("upper", above), ("lower", below)):
        words += [f"-{body}_dm_plex_simplex", str(simplex), f"-{body}_dm_plex_box_faces", f"{n},{n},{n}"]
    total = run.again(*words, *DIRECT, name="mesh").summary["errors_total"]
    return total["energy"], total["l2"]


def judge(run):
    for (simplex, order), (coarse, fine, nearness) in LADDER.items():
        before, after = (errors(run, simplex, order, *mesh) for mesh in (coarse, fine))
        for name, a, b, expected in zip(("energy", "L2"), before, after, (order, order + 1)):
            seen = math.log(a / b) / math.log(fine[0] / coarse[0])
            require(abs(seen - expected) <= nearness, f"the {name} error of order {order} falls with h^{seen:.3f}, simplex {simplex}")
