"""A roller in a groove of 90 degrees: each wall carries weight / sqrt(2) along its normal and nothing across it (statics). p0 is Hertz' for that
force, higher by a share of (a/R)^2 = 0.013."""
import math

from judge import near

MODULUS = 200 / (1 - 0.3**2)


def judge(run):
    force = math.pi / math.sqrt(2)
    for name, side in (("right", -1), ("left", 1)):
        pair = run.pair(name)
        near(f"force of the {name} wall", pair["force"], [side * force / math.sqrt(2), force / math.sqrt(2)], relative=1e-7)
        near(f"tangential force of the {name} wall", pair["force"][0] - side * pair["force"][1], 0, absolute=1e-10)
        near(f"largest pressure at the {name} wall", pair["max_pressure"], math.sqrt(force * MODULUS / math.pi), relative=0.015)
    for more in (["-order", "1"], ["-snes_type", "vinewtonrsls"]):
        other = run.again(*more, name="again" + more[1])
        walls = [other.pair(name) for name in ("right", "left")]
        near(f"the walls with {more}", walls[0]["normal_force"], walls[1]["normal_force"], relative=1e-9)
