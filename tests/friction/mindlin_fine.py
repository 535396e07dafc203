"""Two balls pressed together and sheared, against Mindlin at the forces found: approach, shift, and the circle that sticks, to half a per cent."""
import math

from judge import near, require

MU, RADIUS, MODULUS, SHEAR = 0.3, 5, 1e5, 1e5


def judge(run):
    pair, table = run.pair("joint"), run.table("joint")
    press, shear = 2 * pair["normal_force"], -2 * pair["tangential_force"][0]
    a = (3 * press * RADIUS / (4 * MODULUS)) ** (1 / 3)
    left = 1 - shear / (MU * press)
    require(0.4 < left < 0.6, f"sheared by {1 - left} of what slips everywhere")
    near("approach", 2.24e-2, a * a / RADIUS, relative=5e-3)
    near("shift", 2.487e-3, 3 * MU * press * 2 / (8 * a * SHEAR) * (1 - left ** (2 / 3)), relative=5e-3)
    near("largest pressure", pair["max_pressure"], 3 * press / (2 * math.pi * a**2), relative=5e-3)
    rows = [dict(zip(table, values)) for values in zip(*table.values())]
    areas = {status: sum(row["force"] / row["pressure"] for row in rows if row["status"] == status and row["pressure"] > 0) for status in (3, 4)}
    near("radius that sticks, of that in contact", math.sqrt(areas[4] / (areas[3] + areas[4])), left ** (1 / 3), relative=5e-3)
