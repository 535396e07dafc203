"""Hertz' sphere for the force found (Johnson, Contact mechanics, chapter 4): p = p0 sqrt(1 - r^2/a^2), in space."""
import math

import numpy as np

from judge import near

MODULUS = 1 / ((1 - 0.3**2) / 210000 + (1 - 0.33**2) / 70000)
RADIUS, QUARTERS, ALLOWED = 10, 4, 5e-3


def judge(run):
    pair, table = run.pair("joint"), run.table("joint")
    force = QUARTERS * pair["force"][2]
    radius = (3 * force * RADIUS / (4 * MODULUS)) ** (1 / 3)
    peak = 3 * force / (2 * math.pi * radius**2)
    assert radius / RADIUS < 0.03, radius
    near("largest pressure", pair["max_pressure"], peak, relative=ALLOWED)
    near("the axis has it", pair["max_pressure_at"], [0, 0, 0], absolute=0.2 * radius)
    square, p, f = (np.square(table["x"]) + np.square(table["y"]), *(np.array(table[name]) for name in ("pressure", "force")))
    inside = (square > 0) & (square < (0.9 * radius) ** 2)
    near("largest pressure of the profile", math.sqrt(np.polyfit(square[inside], p[inside] ** 2, 1)[1]), peak, relative=ALLOWED)
    near("radius by the second moment of the pressure", math.sqrt(2.5 * (f @ square) / f.sum()), radius, relative=ALLOWED)
    near("radius by the area", math.sqrt(QUARTERS * pair["area"] / math.pi), radius, relative=2 * ALLOWED)  # cells at the edge: radius / 5
