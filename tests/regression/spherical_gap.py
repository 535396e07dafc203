"""R6B: an independent high-order reference and its uncertainties; to them comes what the mesh leaves, 0.25 % of the force measured."""
import math

import numpy as np

from judge import near

QUARTERS = 4
FORCE, POTENTIAL, CENTRE, RADIUS, SUNK = 20.503, 0.38977, 81.70, 0.3495, -0.017049


def judge(run):
    pair = run.pair("joint")
    near("force", QUARTERS * pair["normal_force"], FORCE, absolute=0.012, relative=3e-3)
    near("potential energy", QUARTERS * run.summary["energy"]["potential"], POTENTIAL, absolute=3e-5, relative=3e-3)
    near("pressure at the centre", pair["max_pressure"], CENTRE, absolute=0.05, relative=5e-3)
    near("place of the centre", pair["max_pressure_at"], [0, 0, 0], absolute=1e-12)
    table = run.table("joint")
    square, p = np.square(table["x"]) + np.square(table["y"]), np.array(table["pressure"])
    inside = (square > 0) & (square < (0.9 * RADIUS) ** 2)
    slope, top = np.polyfit(square[inside], p[inside] ** 2, 1)  # p^2 = p0^2 (1 - r^2/a^2)
    near("radius of the profile", math.sqrt(-top / slope), RADIUS, absolute=0.0015)
    near("depth of the centre", run.probe("centre")["displacement"], [0, 0, SUNK], absolute=4e-7, relative=1e-3)
