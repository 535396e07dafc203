"""Lame's pipe in plane strain whose inner or outer radius is given, in space and askew: u = A r + B/r."""
import math

import numpy as np

from judge import near

YOUNG, POISSON, INNER, OUTER, LENGTH = 1000, 0.3, 1, 2, 0.5


def judge(run):
    radius = float(run.arguments[run.arguments.index("-fit_obstacle_radius") + 1])
    moved, free = (INNER, OUTER) if radius > 0 else (OUTER, INNER)
    stress = lambda r: YOUNG / (1 + POISSON) * np.array([1 / (1 - 2 * POISSON), -1 / r**2])  # radial, of A and of B
    factors = np.linalg.solve([[moved, 1 / moved], stress(free)], [abs(radius) - moved, 0])
    pressure = -stress(moved) @ factors
    table = run.table("fit")
    near("pressure", table["pressure"], [pressure] * len(table["pressure"]), relative=5e-3)
    near("force", run.pair("fit")["normal_force"], pressure * moved * math.pi / 2 * LENGTH, relative=1e-3)
    near("strain energy", run.summary["energy"]["strain"]["pipe"], pressure * moved * math.pi / 4 * LENGTH * abs(abs(radius) - moved), relative=1e-3)
