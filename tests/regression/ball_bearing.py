"""A ball in the groove of a bearing touches it in Hertz' ellipse (Johnson, Contact mechanics, chapter 4). Integrals are computed here."""
import math

import numpy as np

from judge import near

MODULUS = 210000 / (2 * (1 - 0.3**2))
ACROSS, ALONG = 1 / 5 - 1 / 5.5, 1 / 5 + 1 / 20  # relative curvatures


def integrals(m):
    """Complete elliptic integrals K and E of the parameter m = e^2, by the arithmetic-geometric mean."""
    a, b, power, total = 1.0, math.sqrt(1 - m), 0.5, m / 2
    while abs(a - b) > 1e-15:
        a, b, c = (a + b) / 2, math.sqrt(a * b), (a - b) / 2
        power *= 2
        total += power * c * c
    return math.pi / (2 * a), math.pi / (2 * a) * (1 - total)


def excess(m):
    k, e = integrals(m)
    return (e / (1 - m) - k) / (k - e) - ALONG / ACROSS


def ellipse(force):
    """Half axes and largest pressure."""
    low, high = 1e-6, 1 - 1e-12
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (low, middle) if excess(middle) > 0 else (middle, high)
    k, e = integrals(low)
    a = (3 * force * (k - e) / (math.pi * MODULUS * ACROSS * low)) ** (1 / 3)
    b = a * math.sqrt(1 - low)
    return a, b, 3 * force / (2 * math.pi * a * b)


def judge(run):
    pair = run.pair("track")
    a, b, peak = ellipse(4 * pair["force"][2])
    near("largest pressure", pair["max_pressure"], peak, relative=0.015)
    table = run.table("track")
    x, y, f = (np.array(table[name]) for name in ("x", "y", "force"))
    near("long half axis", math.sqrt(5 * sum(f * x * x) / sum(f)), a, relative=0.015)
    near("short half axis", math.sqrt(5 * sum(f * y * y) / sum(f)), b, relative=0.01)
