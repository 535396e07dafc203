"""Hertz' ball for the force found (Johnson, Contact mechanics, chapter 4): p = p0 sqrt(1 - r^2/a^2), on a quarter of a block."""
import math

import numpy as np

from judge import near

MODULUS, RADIUS = 70000 / (1 - 0.33**2), 10


def judge(run):
    force = 4 * run.pair("dent")["normal_force"]
    radius = (3 * force * RADIUS / (4 * MODULUS)) ** (1 / 3)
    peak = 3 * force / (2 * math.pi * radius**2)
    table = run.table("dent")
    r, p = np.hypot(table["x"], table["y"]), np.array(table["pressure"])
    near("pressure under the ball", p[np.argmin(r)], peak, relative=1e-2)
    inside = r < 0.9 * radius
    slope, square = np.polyfit(r[inside] ** 2, p[inside] ** 2, 1)  # p^2 = p0^2 (1 - r^2/a^2)
    near("radius of the profile", math.sqrt(-square / slope), radius, relative=1e-2)
    near("area", 4 * run.pair("dent")["area"], math.pi * radius**2, relative=0.15)  # cells of some 0.25 radius
