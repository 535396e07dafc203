"""A wheel on a rail, of both the half x > 0: an elliptic contact of curved tetrahedra from a file, against Hertz.

The closed form is in K. L. Johnson, Contact Mechanics (1985), section 4.2. K(e), E(e) are the complete elliptic integrals for
e^2 = 1 - (b/a)^2. A and B are the curvatures along the longer and the shorter axis:

    B/A = ((a/b)^2 E - K) / (K - E),   a^3 = 3 F (K - E) / (2 pi E* e^2 A)"""
from math import pi, sqrt

import numpy as np

from judge import near

LOAD, YOUNG, POISSON = 1e5, 210000, 0.3
ALONG, ACROSS = 1 / 920, 1 / 600  # half of the curvatures


def integrals(m):
    """K and E of the parameter m = e^2."""
    x, w = np.polynomial.legendre.leggauss(60)
    s = np.sqrt(1 - m * np.sin((x + 1) * pi / 4)**2)
    return float(w @ (1 / s)) * pi / 4, float(w @ s) * pi / 4


def hertz():
    """Semi-axes along and across, largest pressure."""
    low, high = 1e-3, 1 - 1e-3
    for _ in range(60):
        m = (low + high) / 2
        K, E = integrals(m)
        low, high = (m, high) if (E / (1 - m) - K) / (K - E) < ACROSS / ALONG else (low, m)
    a = (3 * LOAD * (K - E) / (2 * pi * (YOUNG / (2 * (1 - POISSON**2))) * m * ALONG))**(1 / 3)
    b = a * sqrt(1 - m)
    return a, b, 3 * LOAD / (2 * pi * a * b)


def judge(run):
    along, across, pressure = hertz()
    near("semi-axis along the rail, as told in the scene", along, 7.162, relative=1e-4)
    near("semi-axis across, as told in the scene", across, 5.387, relative=1e-4)
    near("largest pressure, as told in the scene", pressure, 1237.6, relative=1e-4)
    # the load is a traction on a cylinder, of which the mesh has parabolas
    near("the rail carries the load", run.pair("contact")["force"][2], -LOAD / 2, relative=1e-7)
    # cells of 2 mm: finer meshes and coarser ones are off by 0.3 to 1.8 %
    near("largest pressure", run.pair("contact")["max_pressure"], pressure, relative=2e-2)
