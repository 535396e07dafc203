"""A hub with a bonded lining on a hollow shaft, plane stress: Lame's u = A r + B / r in three rings. The six numbers follow from free rims
and from equal radial stresses at the fit and at the bond. The differences of displacement there are the interference, and 0."""
import math

import numpy as np

from judge import near, require

RINGS = [(10.0, 20.0, 210e3, 0.3), (20.0, 24.0, 100e3, 0.34), (24.0, 40.0, 210e3, 0.3)]  # radii, E, nu
INTERFERENCE = 0.03


def displacement(r):
    return np.array([r, 1 / r])


def stress(ring, r, sign):
    """Factors of A and B: sign -1 for sigma_rr, 1 for sigma_tt."""
    _, _, young, poisson = ring
    return young / (1 - poisson**2) * np.array([1 + poisson, sign * (1 - poisson) / r**2])


def solve():
    matrix, rhs = np.zeros((6, 6)), np.zeros(6)
    matrix[0, 0:2] = stress(RINGS[0], 10.0, -1)
    matrix[1, 4:6] = stress(RINGS[2], 40.0, -1)
    for i, r in enumerate((20.0, 24.0)):
        inner, outer = slice(2 * i, 2 * i + 2), slice(2 * i + 2, 2 * i + 4)
        matrix[2 + 2 * i, inner], matrix[2 + 2 * i, outer] = -displacement(r), displacement(r)
        matrix[3 + 2 * i, inner], matrix[3 + 2 * i, outer] = stress(RINGS[i], r, -1), -stress(RINGS[i + 1], r, -1)
    rhs[2] = INTERFERENCE
    return np.linalg.solve(matrix, rhs).reshape(3, 2)


def hoop(run):
    xx, yy, _, _, _, xy = run.probe("steel")["stress"]
    return (xx + yy) / 2 - xy


def judge(run):
    factors = solve()
    pressure = -stress(RINGS[1], 20.0, -1) @ factors[1]
    near("mean pressure", run.pair("fit")["mean_pressure"], pressure, relative=1e-5)
    near("largest pressure", run.pair("fit")["max_pressure"], pressure, relative=2e-4)
    near("rim", math.hypot(*run.probe("rim")["displacement"]), displacement(40.0) @ factors[2], relative=1e-4)
    for probe, ring in (("lining", 1), ("steel", 2)):  # on both sides of the bond
        xx, yy, _, _, _, xy = run.probe(probe)["stress"]
        near(f"stress along and across the bond, {probe}", [(xx + yy) / 2 - xy, (xx + yy) / 2 + xy],
             [stress(RINGS[ring], 24.0, sign) @ factors[ring] for sign in (1, -1)], relative=0.02)
    finer = run.again("-dm_refine", "1", name="finer")
    errors = [abs(hoop(r) - stress(RINGS[2], 24.0, 1) @ factors[2]) for r in (run, finer)]
    require(errors[1] < errors[0] / 2, f"the stress at the bond does not approach that of the steel: {errors}")
