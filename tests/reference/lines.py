"""lines.py -- a pair in the plane for independent.py: facets as polynomial curves, normals, rays.

A facet is the curve x(s) = sum phi_i(s) x_i, 0 <= s <= 1, of degree 1 or 2, kept as coefficients [power][2]; so is its
normal field n(s) = sum phi_i(s) n_i. Whatever has to be found on it is a root of a polynomial.
"""
import math

import numpy as np
from numpy.polynomial import polynomial as poly

from bodies import MANY, gauss, numbers
from contact import Pair, unit

LINES = {2: np.array([[1, -1], [0, 1]]), 3: np.array([[1, -3, 2], [0, -1, 2], [0, 4, -4]])}  # phi by powers of s
PLACES = (0.0, 1.0, 0.5)  # of the nodes of a facet


def curve(values):
    """Coefficients of sum_i phi_i(s) values_i."""
    return LINES[len(values)].T @ values


def seen_from(c, point):
    """Coefficients of x(s) - point."""
    return np.vstack([c[:1] - point, c[1:]])


def cross(a, b):
    """a_x b_y - a_y b_x of two curves."""
    return poly.polysub(poly.polymul(a[:, 0], b[:, 1]), poly.polymul(a[:, 1], b[:, 0]))


def roots(p):
    """Real roots. Leading coefficients that are rounding are dropped; two Newton steps clean what the eigenvalues gave."""
    large = np.flatnonzero(np.abs(p) > 1e-14 * np.abs(p).max(initial=0.0))
    found = poly.polyroots(p[:large[-1] + 1]) if len(large) else []
    real = [z.real for z in found if abs(z.imag) < 1e-9]
    for _ in range(2):
        real = [s - poly.polyval(s, p) / slope if (slope := poly.polyval(s, poly.polyder(p))) else s for s in real]
    return real


def outward(c, s):
    """The normal (dy, -dx)/ds of a curve whose body lies on its left; its length is |dx/ds|."""
    x, y = poly.polyval(s, poly.polyder(c))
    return np.array([y, -x])


def chord(c):
    return math.hypot(*c[1:].sum(axis=0))  # x(1) - x(0)


class LinePair(Pair):
    """Where points of a side meet the other one along the normals between nodal ones."""

    def __init__(self, name, scene):
        self.distance = None
        super().__init__(name, scene)

    def read_obstacle(self, option):
        """Distance of a rigid obstacle along the ray x + t n: a plane, or a parabola y = y_0 + (x - x_0)^2 / (2 R) that points down."""
        kind, normal, point = option("obstacle"), np.array(numbers(option("obstacle_normal"))), np.array(numbers(option("obstacle_point")))
        if kind == "plane":
            self.distance = lambda x, n: (point - x) @ normal / (n @ normal)
            return
        radius = float(option("obstacle_radius"))
        if kind != "parabola" or list(normal) != [0.0, -1.0]:
            raise ValueError("the only obstacles here are planes and a parabola that points down")

        def distance(x, n):
            if n[0] != 0:
                raise ValueError("rays to the parabola are vertical")
            return point[1] + (x[0] - point[0])**2 / (2 * radius) - x[1]
        self.distance = distance

    def geometry(self, facet):
        return curve(self.scene.points[list(facet)])

    def set_normals(self):
        """(T13): normals of the curves at a node over their chords, to be normalised."""
        self.normal = {node: np.zeros(2) for node in self.nodes}
        for facet in self.facets:
            c = self.geometry(facet)
            for node, s in zip(facet, PLACES):
                self.normal[node] += unit(outward(c, s)) / chord(c)

    # --- where the two sides see each other ---

    def cuts(self, x, n):
        """Where on a facet some vertex y of the mortar side lies on the ray: cross(x(s) - y, n(s)) = 0."""
        found = {0.0, 1.0}
        for y in self.scene.points[sorted({node for facet in self.mortar for node in facet[:2]})]:
            found.update(s for s in roots(cross(seen_from(x, y), n)) if 0 < s < 1)
        found = sorted(found)
        return [s for i, s in enumerate(found) if i == 0 or s - found[i - 1] > 1e-12]

    def meet(self, x, n, facets):
        """The ray x + t n and the mortar side: (|t|, t, s, facet) of the nearest facet that faces it; None if there is none."""
        hits = []
        for facet in facets:
            c = self.geometry(facet)
            for s in roots(cross(seen_from(c, x), n[None, :])):
                if -1e-9 <= s <= 1 + 1e-9 and unit(outward(c, s)) @ n < -0.3:
                    t = (poly.polyval(s, c) - x) @ n
                    hits.append((abs(t), t, s, facet))
        return min(hits, default=None)

    def rays(self, facet):
        x, n = self.geometry(facet), curve(np.array([self.normal[node] for node in facet]))
        quadratic = len(x) == 3 or self.mortar and len(self.mortar[0]) == 3
        turns = np.abs(n[1:]).max() > 1e-12
        points, weights = gauss(MANY if quadratic else 4 if turns or not self.mortar else 2)
        ends = self.cuts(x, n) if self.mortar else [0.0, 1.0]
        ray = lambda s: (poly.polyval(s, x), unit(poly.polyval(s, n)))
        for begin, end in zip(ends[:-1], ends[1:]):
            seen = self.meet(*ray(0.5 * (begin + end)), self.mortar) if self.mortar else True
            for s, w in zip(begin + points * (end - begin), weights * (end - begin)) if seen else ():
                w *= math.hypot(*outward(x, s))
                point, direction = ray(s)
                if not self.mortar:
                    yield (s,), w, self.distance(point, direction), {}
                    continue
                _, gap, eta, facet = self.meet(point, direction, [seen[3]])
                yield (s,), w, gap, dict(zip(facet, poly.polyval(eta, LINES[len(facet)].T)))
