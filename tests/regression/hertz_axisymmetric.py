"""Hertz' sphere for the force found (Johnson, Contact mechanics, chapter 4): p = p0 sqrt(1 - r^2/a^2), on curved cells."""
import math

import numpy as np

from judge import near

MODULUS = 1 / ((1 - 0.3**2) / 210000 + (1 - 0.33**2) / 70000)
RADIUS = 10


def judge(run):
    again = run.again("-dm_refine", "1", name="fine")
    pair = again.pair("joint")
    force = pair["force"][1]
    radius = (3 * force * RADIUS / (4 * MODULUS)) ** (1 / 3)
    peak = 3 * force / (2 * math.pi * radius**2)
    assert radius / RADIUS < 0.03, radius
    near("largest pressure", pair["max_pressure"], peak, relative=5e-3)
    near("pressure is where the axis is", pair["max_pressure_at"], [0, 0], absolute=0.1 * radius)
    table = again.table("joint")
    r, p = np.array(table["x"]), np.array(table["pressure"])
    near("pressure on the axis", p[np.argmin(r)], peak, relative=5e-3)
    inside = (r > 0) & (r < 0.9 * radius)
    slope, square = np.polyfit(r[inside] ** 2, p[inside] ** 2, 1)  # p^2 = p0^2 (1 - r^2/a^2)
    near("largest pressure of the profile", math.sqrt(square), peak, relative=5e-3)
    near("radius of the profile", math.sqrt(-square / slope), radius, relative=5e-3)
