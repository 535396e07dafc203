"""closedforms.py -- contact of half planes and half spaces in closed form, for options/CONTACT_ZONE.md and its tests.

Lengths, pressures and forces are in one set of units; modulus is E*, 1/E* the sum of (1 - nu^2)/E of both bodies. Sources: K. Johnson, Contact
mechanics, 1985 (Hertz, 4.2 and 4.3; flat punches, 2.8 and 3.4); M. Ciavarella, D. Hills, G. Monno, 1998 (rounded edges)."""
import math

import numpy as np


def agm(k2):
    """Complete elliptic integrals K and E of the parameter k^2, by the arithmetic-geometric mean."""
    a, b, c, power, total = 1.0, math.sqrt(1 - k2), math.sqrt(k2), 1.0, k2 / 2
    while abs(c) > 1e-16:
        a, b, c = (a + b) / 2, math.sqrt(a * b), (a - b) / 2
        total += power * c * c
        power *= 2
    K = math.pi / 2 / a
    return K, K * (1 - total)


def line(force, radius, modulus):
    """Hertz in the plane: half width and largest pressure under a force per length."""
    return math.sqrt(4 * force * radius / math.pi / modulus), math.sqrt(force * modulus / math.pi / radius)


def ellipse(force, radius_x, radius_y, modulus):
    """Hertz in space, gap x^2/(2 radius_x) + y^2/(2 radius_y): half axes along x and y, and the largest pressure."""
    if radius_x > radius_y:
        b, a, p0 = ellipse(force, radius_y, radius_x, modulus)
        return a, b, p0
    ratio = radius_x / radius_y  # x is the short axis: ratio of the coefficients along the long and the short one
    low, high = 0.0, 1 - 1e-12
    for _ in range(200):  # of e^2; the ratio of the coefficients falls from 1 to 0
        e2 = (low + high) / 2
        K, E = agm(e2)
        low, high = (e2, high) if e2 < 1e-14 or (K - E) / (E / (1 - e2) - K) > ratio else (low, e2)
    K, E = agm(e2)
    k = math.sqrt(1 - e2)  # short over long axis
    # 1/(2 radius_y) = p0/E* b/(e^2 a^2) (K - E), F = 2/3 pi a b p0
    shape = (K - E) / e2 if e2 > 1e-10 else math.pi / 4
    a = (3 * force * radius_y * shape / (math.pi * modulus))**(1 / 3)
    return k * a, a, 3 * force / (2 * math.pi * k * a * a)


def elliptic_punch(short, long, modulus):
    """Force over depth of a flat punch on an ellipse of these half axes: also dF/dd of the ellipse of Hertz."""
    return math.pi * modulus * long / agm(1 - (short / long)**2)[0]


def rounded(force, flat, radius, modulus):
    """A punch in the plane, flat on |x| < flat and round beside it, gap (|x| - flat)^2/(2 radius): half width under a force."""

    def total(a):
        phi = math.asin(flat / a)
        return modulus * a * a / (2 * radius) * (math.pi / 2 - phi - math.sin(phi) * math.cos(phi))

    low, high = flat, flat + 10 * math.sqrt(4 * force * radius / math.pi / modulus)
    for _ in range(200):
        a = (low + high) / 2
        low, high = (a, high) if total(a) < force else (low, a)
    return a


def rounded_pressure(x, half, flat, radius, modulus, points=20000):
    """Its pressure at x: a sum of Gauss and Chebyshev for the singular integral, whose points avoid x."""
    x = np.atleast_1d(np.asarray(x, dtype=float))
    t = np.cos(math.pi * (np.arange(points) + 0.5) / points)
    slope = lambda s: np.sign(s) * np.maximum(np.abs(s) - flat, 0) / radius
    at = slope(x)[:, None]
    # p = E*/(2 pi) sqrt(a^2 - x^2) int (g'(s) - g'(x))/((s - x) sqrt(a^2 - s^2)) ds, and that of 1/(s - x) alone is 0
    quotient = (slope(half * t)[None, :] - at) / (half * t[None, :] - x[:, None])
    return modulus / (2 * math.pi) * np.sqrt(np.maximum(half**2 - x**2, 0)) * quotient.sum(axis=1) * math.pi / points


def ring_punch(inner, outer, elements=200):
    """F/(2 E* outer d) of a flat ring pressed d deep into a half space; rings of constant pressure, by collocation. 1 for a disc."""
    angle = math.pi * np.arange(elements + 1) / elements
    edges = (inner + outer) / 2 - (outer - inner) / 2 * np.cos(angle) if inner > 0 else outer * np.sin(angle / 2)
    middle = (edges[1:] + edges[:-1]) / 2
    nodes, weights = np.polynomial.legendre.leggauss(6)
    A = np.zeros((elements, elements))
    for i, r in enumerate(middle):
        for j in range(elements):
            parts = [edges[j], r, edges[j + 1]] if i == j else [edges[j], edges[j + 1]]
            for a, b in zip(parts, parts[1:]):
                # the logarithm at r is integrated in the variable whose square is the distance
                q = (nodes + 1) / 2
                s, w = (r + (a - r) * q**3, 3 * q**2 * abs(a - r)) if b == r else (r + (b - r) * q**3, 3 * q**2 * abs(b - r)) if a == r else (a + (b - a) * q, b - a)
                k2 = 4 * r * s / (r + s)**2
                K = np.array([agm(min(value, 1 - 1e-15))[0] for value in k2])
                A[i, j] += np.sum(weights / 2 * w * s * K / (r + s))
    pressure = np.linalg.solve(4 / math.pi * A, np.ones(elements))
    return float(np.sum(pressure * math.pi * (edges[1:]**2 - edges[:-1]**2)) / (2 * outer))
