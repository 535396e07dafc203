"""Timoshenko, Analysis of bi-metal thermostats (1925): far from its ends a strip of two metals bends by the curvature
6 (a1 - a2) T (1 + m)^2 / (h (3 (1 + m)^2 + (1 + m n) (m^2 + 1 / (m n)))), m = h1 / h2, n = E1 / E2: the lower layer, which grows more, is
outside, so the strip bends up. Quadratic cells have the solution exactly there; what the ends disturb falls by exp(-4) for each height at least."""
from judge import near


def curvature(run):
    below, middle, above = (run.probe(name)["displacement"][1] for name in "abc")
    return (below - 2 * middle + above) / 16


def judge(run):
    m, n, h, difference = 0.3 / 0.7, 0.5, 1.0, 1e-5 * 100
    expected = 6 * difference * (1 + m)**2 / (h * (3 * (1 + m)**2 + (1 + m * n) * (m**2 + 1 / (m * n))))
    near("curvature", curvature(run), expected, relative=1e-6)
