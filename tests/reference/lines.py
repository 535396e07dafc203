"""lines.py -- a pair in the plane for independent.py: facets as polynomial curves, normals, rays.

A facet is the curve x(s) = sum phi_i(s) x_i, 0 <= s <= 1, of degree 1 or 2, kept as coefficients [power][2]; so is its
normal field n(s) = sum phi_i(s) n_i. Whatever has to be found on it is a root of a polynomial.
"""
import math

import numpy as np
from numpy.polynomial import polynomial as poly

from bodies import MANY, gauss, numbers
from contact import Pair, beside, frame, turning, unit

LINES = {2: np.array([[1, -1], [0, 1]]), 3: np.array([[1, -3, 2], [0, -1, 2], [0, 4, -4]])}  # phi by powers of s
FLAT, NONE = 1e-11, 1e-8  # differences of unit normals, and shares of curvatures, that are rounding


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


def share(own, other):
    """How much of the turn a side of one curvature makes towards the other one's normal."""
    size = NONE * (abs(own) + abs(other))
    if abs(own) <= size:
        return 0.0
    if abs(own + other) <= size:
        return 0.5
    return min(max(own / (own + other), 0.0), 1.0) if own + other > 0 else float(abs(own) > abs(other))


class LinePair(Pair):
    """Where points of a side meet the other one along the normals between nodal ones."""

    def __init__(self, name, scene):
        self.distance = self.flat_obstacle = None
        super().__init__(name, scene)

    def read_obstacle(self, option):
        """Distance of a rigid obstacle along the ray x + t n: a plane, or a parabola y = y_0 + (x - x_0)^2 / (2 R) that points down."""
        kind, normal, point = option("obstacle"), np.array(numbers(option("obstacle_normal"))), np.array(numbers(option("obstacle_point")))
        if kind == "plane":
            self.distance = lambda x, n: (point - x) @ normal / (n @ normal)
            self.flat_obstacle = unit(normal)
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
        """The directions of contact (eq. 4.3), from normals and curvatures of both sides."""
        self.normal, kappa = self.side_shape(self.facets)
        self.rise = self.rises(self.facets, self.normal)
        if self.distance and self.flat_obstacle is not None:
            self.normal = {node: -self.flat_obstacle for node in self.nodes}
        elif self.distance and any(kappa.values()):
            raise ValueError("a parabola wants a flat side here")
        normal_m, kappa_m = self.side_shape(self.mortar) if self.mortar else ({}, {})
        self.rise = self.rise | self.rises(self.mortar, normal_m) if any(kappa_m.values()) else {}
        if self.mortar and any(kappa.values()):
            self.normal = {node: self.direction(node, n, kappa[node], normal_m, kappa_m) for node, n in self.normal.items()}

    def rises(self, facets, normal):
        """{facet: (s, p, q)}: from its middle to that of the arc between the normals at its ends (eq. 4.5), for a straight one; what the slopes at the ends
        lack (eq. 4.5a)."""
        found = {}
        if not facets or self.scene.owner(facets).polygonal:
            return found
        for a, b, *middle in facets:
            step, mean = self.scene.points[b] - self.scene.points[a], normal[a] + normal[b]
            ends = [-normal[a] @ step, normal[b] @ step]  # alike on a circle
            across = unit(mean - (mean @ step) / (step @ step) * step)
            rise = self.scene.points[middle[0]] - (self.scene.points[a] + self.scene.points[b]) / 2 if middle else np.zeros(2)
            if not middle and min(ends) * max(ends) > 0 and min(map(abs, ends)) > FLAT * math.hypot(*step):
                rho = (ends[1] - ends[0]) / sum(ends)
                rise = across * (1 - rho**4) * sum(ends) / 2 / (2 + math.hypot(*mean))
            lack = [-(step + sign * 4 * rise) @ normal[node] / (across @ normal[node]) for node, sign in ((a, 1), (b, -1))]
            if rise.any():
                smooth = max(map(abs, lack)) <= 2 * math.hypot(*rise)
                parts = [(lack[0] + sign * lack[1]) / 2 * across if smooth else np.zeros(2) for sign in (1, -1)]
                found[(a, b, *middle)] = [np.zeros(2) if middle else rise, *parts]
        return found

    def bulge(self, facet, s, n):
        """How far along n the curve is off the facet; of degree 4."""
        if tuple(facet) not in self.rise:
            return 0.0
        rise, p, q = self.rise[tuple(facet)]
        return s * (1 - s) * (4 * rise + (1 - 2 * s) * (p + (1 - 2 * s) * q)) @ n

    def side_shape(self, facets):
        """{node: unit normal}, {node: curvature} of a smooth side. Circles: normals of the chords between nodes over their lengths (eq. 4.1); normals
        from these by eq. 4.1b."""
        around, circle, ahead = {}, {}, {}
        for facet in facets:
            along = [facet[0], *facet[2:], facet[1]]
            for node in facet:
                around.setdefault(node, []).append(facet)
            for a, b in zip(along, along[1:]):
                dx, dy = self.scene.points[b] - self.scene.points[a]
                ahead[a] = b
                for node in (a, b):
                    circle[node] = circle.get(node, 0.0) + np.array([dy, -dx]) / (dx * dx + dy * dy)
        circle = {node: unit(n) for node, n in circle.items()}
        normal = self.normals_of(circle, ahead)
        return normal, {node: self.curvature(node, around, normal, around) for node in around}

    def normals_of(self, circle, ahead):
        """{node: normal} from four chords around each node (eq. 4.1b). [in] circle - normals from two; ahead - {node: the next one}"""
        ways = (ahead, {b: a for a, b in ahead.items()})
        inner = ways[0].keys() & ways[1].keys()
        length = lambda a, b: math.hypot(*(self.scene.points[b] - self.scene.points[a]))
        both = {node: sum(length(node, way[node]) for way in ways) for node in inner}

        def mirrored(n, a, b):
            step = self.scene.points[b] - self.scene.points[a]
            return n - 2 * (n @ step) / (step @ step) * step

        def goes_on(node, way):
            """Whether the circle of a node passes through one chord more on a way."""
            other = way[node]
            if other not in inner:
                return False
            image = mirrored(circle[other], node, other)
            return np.linalg.norm(circle[node] - image) <= max(1e-4 * np.linalg.norm(circle[other] - image), FLAT)

        normal, curved = dict(circle), set()
        for node in inner:
            if any(goes_on(node, way) for way in ways):
                continue
            known = [way for way in ways if way[node] in inner]
            exact = [mirrored(circle[way[node]], node, way[node]) for way in known if goes_on(way[node], way)]
            if exact:
                normal[node] = unit(sum(exact))
                continue
            curved.add(node)
            means = []  # of both circles on a way, with the length of both chords there
            for way in known:
                beyond, near = both[way[node]], both[node] - length(node, way[node])
                means.append((beyond, (beyond * circle[node] + near * mirrored(circle[way[node]], node, way[node])) / (beyond + near)))
            if len(means) == 2:
                normal[node] = unit(means[1][0] * means[0][1] + means[0][0] * means[1][1])
            elif means:
                normal[node] = unit(means[0][1])
        for end in circle.keys() - inner:
            near = next(way[end] for way in ways if end in way)
            if near in inner:
                image, own = mirrored(normal[near], end, near), length(end, near)
                turn = np.linalg.det([normal[near], circle[near]]) * own / (both[near] - own) if near in curved else 0.0
                normal[end] = unit(image + turn * np.array([-image[1], image[0]]))
        return normal

    def curvature(self, node, around, normal, counted):
        """Mean of dn/dx along the tangent over the other nodes of the facets at a node; None without one that counts."""
        slopes, tau = [], np.array([-normal[node][1], normal[node][0]])
        for other in (b for facet in around[node] for b in facet if b != node and b in counted):
            dn, dx = ((values[other] - values[node]) @ tau for values in (normal, self.scene.points))
            slopes.append(dn / dx if np.abs(dn * tau).max() > FLAT else 0.0)
        return sum(slopes) / len(slopes) if slopes else None

    def direction(self, node, n, kappa, normal_m, kappa_m):
        """The normal of the side, turned towards that of the other side where the latter, between those of nodes, leads through the node; with the
        curvature of the parallel curve through the node. Where no normal of a facet does, its nearest point is taken."""
        hits, x = [], self.scene.points[node]
        for facet in self.mortar:
            c, normals = seen_from(self.geometry(facet), x), curve(np.array([normal_m[b] for b in facet]))
            square = poly.polyadd(*(poly.polymul(c[:, k], c[:, k]) for k in range(2)))
            feet = [s for s in roots(cross(c, normals)) if -1e-12 <= s <= 1 + 1e-12]
            if not feet:
                places = [0.0, 1.0] + [s for s in roots(poly.polyder(square)) if 0 < s < 1]
                feet = [min(places, key=lambda place: poly.polyval(place, square))]
            for s in feet:
                weights, n_m, away = poly.polyval(s, LINES[len(facet)].T), unit(poly.polyval(s, normals)), poly.polyval(s, c)
                aside = away @ away - (away @ n_m)**2
                if n_m @ n < 0.5:
                    hits.append((bool(n_m @ n >= -0.3), away @ away + 100 * max(aside, 0.0), tuple(n_m), tuple(away), tuple(weights), facet))
        if not hits:
            return n
        _, _, n_m, away, weights, facet = min(hits)
        n_m, tau = np.array(n_m), np.array([-n_m[1], n_m[0]])
        other = sum(w * kappa_m[b] for w, b in zip(weights, facet))
        rise = 0.5 * other * sum(w * ((self.scene.points[b] - x - away) @ tau)**2 for w, b in zip(weights, facet))
        height = -np.array(away) @ n_m - rise
        if 1 + height * other > 0.1:
            other /= 1 + height * other
        return self.turned(n, kappa, n_m, other)

    @staticmethod
    def turned(n, kappa, n_m, other):
        """n turned towards -n_m by the share that the curvatures give it."""
        if other == 0.0 and kappa != 0.0:
            return -n_m
        tau = frame(unit(n - n_m))[1]
        return unit(n - share(kappa, other) * ((n + n_m) @ tau) * tau)

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
                    yield (s,), w, self.distance(point, direction) - self.bulge(facet, s, direction), {}, {} if self.tied else lambda along: {}
                    continue
                _, gap, eta, other = self.meet(point, direction, [seen[3]])
                gap += self.bulge(other, eta, direction) - self.bulge(facet, s, direction)
                yield (s,), w, gap, dict(zip(other, poly.polyval(eta, LINES[len(other)].T))), self.more_at(point, other, eta)

    def more_at(self, point, facet, s):
        c = self.geometry(facet)
        n, slopes, foot = outward(c, s), poly.polyval(s, poly.polyder(LINES[len(facet)].T)), poly.polyval(s, c)
        tangent = np.array([-n[1], n[0]]) / (n @ n)
        gradients = {b: slope * tangent for b, slope in zip(facet, slopes)}
        return turning(point - foot, unit(n), gradients) if self.tied else lambda along: beside(point, foot, unit(n), along, gradients)
