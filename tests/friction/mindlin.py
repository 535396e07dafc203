"""Two balls pressed together and sheared, against Mindlin's tractions at the forces found; some five edges across the radius."""
import math

from judge import near, require

MU, RADIUS, MODULUS = 0.3, 5, 1e5


def judge(run):
    pair, table = run.pair("joint"), run.table("joint")
    press, shear = 2 * pair["normal_force"], -2 * pair["tangential_force"][0]
    a = (3 * press * RADIUS / (4 * MODULUS)) ** (1 / 3)
    p0, left = 3 * press / (2 * math.pi * a**2), 1 - shear / (MU * press)
    require(0.4 < left < 0.6, f"sheared by {1 - left} of what slips everywhere")
    c = left ** (1 / 3)  # over a
    near("largest pressure", pair["max_pressure"], p0, relative=0.01)
    rows = [dict(zip(table, values)) for values in zip(*table.values())]
    held = [row for row in rows if row["status"] in (3, 4) and row["pressure"] > 0]
    (middle,) = [row for row in held if math.hypot(row["x"], row["y"]) < 1e-9]
    near("q in the middle", -middle["tangential_traction_x"] / (MU * p0), 1 - c, relative=0.02)
    areas = {status: sum(row["force"] / row["pressure"] for row in held if row["status"] == status) for status in (3, 4)}
    near("radius that sticks", math.sqrt(areas[4] / (areas[3] + areas[4])), c, relative=0.02)
    forces = [-row["force"] * row["tangential_traction_x"] / row["pressure"] for row in held]
    moment = sum(force * (row["x"] ** 2 + row["y"] ** 2) for force, row in zip(forces, held)) / sum(forces)
    near("second moment of q", moment, 0.4 * a**2 * (1 - c**5) / (1 - c**3), relative=0.015)
