"""A flat rigid punch that slides on a half plane: p = P cos(pi g) / (pi sqrt(1 - x^2)) ((1 + x) / (1 - x))^g with tan(pi g) = mu (1 - 2 nu) / (2 - 2 nu) (Johnson 1985,
section 2.8)."""
import math

from judge import near, require

MU, NU = 0.5, 0.3


def judge(run):
    gamma = math.atan(MU * (1 - 2 * NU) / (2 - 2 * NU)) / math.pi
    pair, table = run.pair("punch"), run.table("punch")
    near("it slides everywhere", pair["slip_share"], 1, relative=1e-12)
    force, share = pair["normal_force"], 0
    near("tangential force", abs(pair["tangential_force"][0]), MU * force, relative=1e-8)  # roundoff of a mesh this graded: the certificate finds 2e-9 in forces
    # A traction along x presses the surface down ahead, by the Flamant solution for a normal force and reciprocity: there the pressure is smaller.
    sense = -1 if table["tangential_traction_x"][table["x"].index(min(table["x"], key=abs))] > 0 else 1
    for x, p in zip(table["x"], table["pressure"]):
        exact = force * math.cos(math.pi * gamma) / (math.pi * math.sqrt(1 - x * x)) * ((1 + sense * x) / (1 - sense * x)) ** gamma if abs(x) < 0.81 else 0
        if abs(x) < 0.81:
            near(f"pressure at x = {x:.4f}", p, exact, relative=5e-3)
            share += 1
        if abs(x) < 1e-9:
            near("p(0) a / P", p / force, 0.315111, relative=2e-3)
    require(share > 50, f"{share} nodes compared")
