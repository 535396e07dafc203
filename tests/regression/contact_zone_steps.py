"""The claims of options/CONTACT_ZONE.md on size. They are Hertz while the zone is small, an exact force when it is the whole
side, and the compliance of a growing line contact. closedforms.py of options/studies has the formulas."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "options" / "studies"))
from closedforms import line  # pylint: disable=wrong-import-position
from judge import near, require, same

MODULUS, R, DEPTH, FACET = 1000 / 0.91 / 2, 1000, 0.0011, 1 / 64


def judge(run):
    steps = [(step["t"] * DEPTH, 2 * step["pairs"]["joint"]["normal_force"], step["pairs"]["joint"]) for step in run.summary["steps"]]
    nodes = [pair["active_nodes"] for _, _, pair in steps]
    same("nodes at the ends", (nodes[0], nodes[-1]), (2, 65))
    require(nodes == sorted(nodes), f"nodes {nodes} do not grow with the force")
    for d, F, pair in steps:
        a, p0 = line(F, R, MODULUS)
        if pair["active_nodes"] >= 4 and a < 0.25:
            near(f"half width at {d:g}", pair["area"], a, absolute=FACET)
            near(f"largest pressure at {d:g}", pair["max_pressure"], p0, relative=0.02)
    d, F, pair = steps[-1]  # the whole side touches: a test displacement of uniaxial stress gives the force, whatever the gap
    near("force of the whole side", F / 2, MODULUS * (d - 1 / 6 / R), relative=1e-9)
    # d = F/(pi E*) (c - ln F): between three steps of a line contact, in terms of secants
    chosen = [(d, F) for d, F, pair in steps if pair["active_nodes"] >= 4 and line(F, R, MODULUS)[0] < 0.25]
    ratios = [d / F for d, F in chosen]
    slope = (ratios[-1] - ratios[0]) / math.log(chosen[-1][1] / chosen[0][1])
    near("slope of d/F over ln F", slope, -1 / math.pi / MODULUS, relative=0.05)
