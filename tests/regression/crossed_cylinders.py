"""Equal cylinders across each other touch as a ball of their radius does a plane (Hertz; Johnson, Contact mechanics, chapter 4)."""
import math

import numpy as np

from judge import near

MODULUS, RADIUS = 210000 / (2 * (1 - 0.3**2)), 10


def judge(run):
    pair = run.pair("cross")
    force = 4 * pair["force"][2]
    radius = (3 * force * RADIUS / (4 * MODULUS)) ** (1 / 3)
    peak = 3 * force / (2 * math.pi * radius**2)
    near("largest pressure", pair["max_pressure"], peak, relative=5e-3)
    table = run.table("cross")
    r, p = np.hypot(table["x"], table["y"]), np.array(table["pressure"])
    inside = r < 0.8 * radius
    slope, square = np.polyfit(r[inside] ** 2, p[inside] ** 2, 1)  # p^2 = p0^2 (1 - r^2/a^2)
    near("radius of the profile", math.sqrt(-square / slope), radius, relative=1e-2)
    near("both extents", pair["extent"]["upper"][0], pair["extent"]["upper"][1], relative=1e-2)
