"""The claims of options/CONTACT_ZONE.md on shapes in space: pressures of Hertz on an ellipse, a circle and a strip. The stiffness is that of a flat
punch on the same zone. For equal areas the circle is the softest shape. The block is no half space: a little too stiff."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "options" / "studies"))
from closedforms import ellipse, elliptic_punch, line  # pylint: disable=wrong-import-position
from judge import near, require

MODULUS, DEPTH = 70000 / 0.91, 0.000125


def stiffness(run, radius, name):
    """dF/dd, the force and the largest pressure of an ellipsoid of radii 1000 and radius."""
    gap = f"x^2/2000+y^2/{2 * radius}-{{!r}}-z"
    low, high = (run.again("-dent_obstacle_gap", gap.format(DEPTH * part), name=f"{name}{part}").pair("dent") for part in (0.97, 1.03))
    middle = (low["max_pressure"] + high["max_pressure"]) / 2
    return 4 * (high["normal_force"] - low["normal_force"]) / (0.06 * DEPTH), 2 * (high["normal_force"] + low["normal_force"]), middle


def judge(run):
    over_disc = []
    for radius, name in ((1000, "circle"), (4000, "ellipse")):
        slope, F, pressure = stiffness(run, radius, name)
        a, b, p0 = ellipse(F, 1000, radius, MODULUS)
        near(f"{name}: largest pressure", pressure, p0, relative=0.01)
        near(f"{name}: dF/dd", slope, elliptic_punch(a, b, MODULUS), relative=0.05)
        over_disc.append(slope / (2 * MODULUS * math.sqrt(a * b)))
    require(1 < over_disc[0] < over_disc[1], f"stiffness over that of a disc of the same area: {over_disc}")
    strip = run.again("-dent_obstacle_gap", "x^2/2000-0.000125-z", "-block_bc_normal", "left,front,back,bottom", name="strip").pair("dent")
    near("strip: largest pressure", strip["max_pressure"], line(2 * strip["normal_force"] / 10, 1000, MODULUS)[1], relative=0.01)
