"""contact.py -- one pair for independent.py: facets as polynomial curves, normals, rays, and the rows of B.

A facet is the curve x(s) = sum phi_i(s) x_i, 0 <= s <= 1, of degree 1 or 2, kept as coefficients [power][2]; so is its
normal field n(s) = sum phi_i(s) n_i. Whatever has to be found on it is a root of a polynomial.
"""
import math

import numpy as np
from numpy.polynomial import polynomial as poly

from bodies import numbers

SLIVER, NOTHING, HELD = {2: 1e-3, 3: 5e-2}, 1e-13, 0.1  # a node with less cover (of facets with 2 or 3 multipliers) or freedom has none
LINES = {2: np.array([[1, -1], [0, 1]]), 3: np.array([[1, -3, 2], [0, -1, 2], [0, 4, -4]])}  # phi by powers of s
PLACES = (0.0, 1.0, 0.5)  # of the nodes of a facet
MANY = 8  # Gauss points of a piece, where a finite number is exact enough but not exact


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


def gauss(count):
    points, weights = np.polynomial.legendre.leggauss(count)
    return 0.5 * (1 + points), 0.5 * weights


def outward(c, s):
    """The normal (dy, -dx)/ds of a curve whose body lies on its left; its length is |dx/ds|."""
    x, y = poly.polyval(s, poly.polyder(c))
    return np.array([y, -x])


def unit(v):
    return v / math.hypot(*v)


def chord(c):
    return math.hypot(*c[1:].sum(axis=0))  # x(1) - x(0)


class Pair:
    """Weights, couplings and gaps of (T4), (T5), and from them the rows of B with one multiplier each."""

    def __init__(self, name, scene):
        self.name, self.scene = name, scene
        option = lambda key, default=None: scene.options.pop(f"{name}_{key}", default)
        self.facets, mortar = scene.side(option("nonmortar")), option("mortar")
        self.mortar = scene.side(mortar) if mortar else None
        self.tied = option("type", "contact") == "tied"
        gap, self.offset = option("gap"), float(option("gap_offset", "0"))
        self.gap = None if gap is None else float(gap)
        self.linear = option("multipliers", "nodes") == "vertices"
        option("reach"), option("exact_pressure")  # everything here is within reach
        if not mortar:
            self.distance = self.read_obstacle(option)
        self.nodes = list(dict.fromkeys(node for facet in self.facets for node in facet))
        self.set_normals()
        self.integrate()
        self.set_rows()

    @staticmethod
    def read_obstacle(option):
        """Distance of a rigid obstacle along the ray x + t n: a plane, or a parabola y = y_0 + (x - x_0)^2 / (2 R) that points down."""
        kind, normal, point = option("obstacle"), np.array(numbers(option("obstacle_normal"))), np.array(numbers(option("obstacle_point")))
        if kind == "plane":
            return lambda x, n: (point - x) @ normal / (n @ normal)
        radius = float(option("obstacle_radius"))
        if kind != "parabola" or list(normal) != [0.0, -1.0]:
            raise ValueError("the only obstacles here are planes and a parabola that points down")

        def distance(x, n):
            if n[0] != 0:
                raise ValueError("rays to the parabola are vertical")
            return point[1] + (x[0] - point[0])**2 / (2 * radius) - x[1]
        return distance

    def geometry(self, facet):
        return curve(self.scene.points[list(facet)])

    def set_normals(self):
        """(T13): normals of the curves at a node over their chords, normalised; then the prescribed directions taken out."""
        self.normal = {node: np.zeros(2) for node in self.nodes}
        for facet in self.facets:
            c = self.geometry(facet)
            for node, s in zip(facet, PLACES):
                self.normal[node] += unit(outward(c, s)) / chord(c)
        self.normal = {node: unit(n) for node, n in self.normal.items()}
        self.free = {}
        for node, n in self.normal.items():
            part = np.array([0.0 if 2 * node + k in self.scene.held else n[k] for k in (0, 1)])
            self.free[node] = math.hypot(*part)
            if self.free[node] >= HELD:
                self.normal[node] = part / self.free[node]

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

    def rays(self, x, n):
        """Gauss points of one facet: s on it, weight, gap, and {mortar node: shape function}."""
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
                    yield s, w, self.distance(point, direction), {}
                    continue
                _, gap, eta, facet = self.meet(point, direction, [seen[3]])
                yield s, w, gap, dict(zip(facet, poly.polyval(eta, LINES[len(facet)].T)))

    # --- integrals and rows ---

    def integrate(self):
        """Per multiplier: its weight D_aa, its weight were all covered, G, and {node: int psi phi, of the mortar side with a
        minus}; psi from the biorthogonality (T6) on what is covered, to phi or, with one multiplier per vertex, to hats."""
        self.D, self.full, self.G, self.row, self.beside = {}, {}, {}, {}, {}
        points, weights = gauss(MANY)
        for facet in self.facets:
            x, n = self.geometry(facet), curve(np.array([self.normal[node] for node in facet]))
            hats = LINES[2 if self.linear else len(facet)].T
            rays = list(self.rays(x, n))
            for i, node in enumerate(facet[:len(hats.T)]):
                whole = sum(w * math.hypot(*outward(x, s)) * poly.polyval(s, hats)[i] for s, w in zip(points, weights))
                self.full[node] = self.full.get(node, 0.0) + whole
            if rays:
                self.add_facet(facet, hats, rays)

    def add_facet(self, facet, hats, rays):
        s, w = np.array([ray[0] for ray in rays]), np.array([ray[1] for ray in rays])
        hat, phi = poly.polyval(s, hats), poly.polyval(s, LINES[len(facet)].T)
        psi = np.diag(hat @ w) @ np.linalg.solve((hat * w) @ hat.T, hat)
        chain = sorted(facet[:len(hat)], key=lambda node: PLACES[facet.index(node)])
        for a, b in zip(chain[:-1], chain[1:]):
            self.beside.setdefault(a, set()).add(b)
            self.beside.setdefault(b, set()).add(a)
        for i, node in enumerate(facet[:len(hat)]):
            self.D[node] = self.D.get(node, 0.0) + w @ hat[i]
            row = self.row.setdefault(node, {})
            for b, value in zip(facet, (psi[i] * w) @ phi.T):
                row[b] = row.get(b, 0.0) + value
            for (_, _, gap, mortar), weight in zip(rays, w * psi[i]):
                self.G[node] = self.G.get(node, 0.0) + weight * ((gap if self.gap is None else self.gap) + self.offset)
                for b, shape in mortar.items():
                    row[b] = row.get(b, 0.0) - weight * shape

    def keeps(self, node):
        """Whether a node carries its multiplier."""
        held = any(2 * node + k in self.scene.held for k in (0, 1))
        least = SLIVER[2 if self.linear else len(self.facets[0])]
        return self.D[node] >= least * self.full[node] and self.free[node] >= HELD and not (self.tied and held)

    def shares(self, kept, removed):
        """{removed node: {kept node: weight}}: the mean over neighbours along the side, in rings around the kept nodes."""
        known, waiting = {a: {a: 1.0} for a in kept}, set(removed)
        while ring := {c: [b for b in self.beside[c] if b in known] for c in waiting if self.beside[c] & known.keys()}:
            known.update({c: {a: sum(known[b].get(a, 0.0) for b in near) / len(near) for b in near for a in known[b]}
                          for c, near in ring.items()})
            waiting -= ring.keys()
        return {c: known.get(c, {}) for c in removed}

    def set_rows(self):
        """Rows of B as {unknown: value} over D_aa; those of removed nodes are shared out among kept ones (T12)."""
        touched = [node for node in self.D if abs(self.D[node]) > NOTHING * self.full[node]]
        kept, self.weight, self.rows = [node for node in touched if self.keeps(node)], {}, []
        row, G = {node: dict(self.row[node]) for node in kept}, {node: self.G[node] for node in kept}
        self.share = self.shares(kept, [node for node in touched if node not in kept])
        for c, a, w in [(c, a, w) for c, share in self.share.items() for a, w in share.items()]:
            G[a] += w * self.G[c]
            for b, value in self.row[c].items():
                row[a][b] = row[a].get(b, 0.0) + w * value
        for a in kept:
            n, D = self.normal[a], self.D[a]
            self.weight[a] = self.scene.thickness * sum(row[a].get(b, 0.0) for b in self.nodes)
            for direction in (n, np.array([-n[1], n[0]])) if self.tied else (n,):
                entries = {2 * b + k: value / D * direction[k] for b, value in row[a].items() for k in (0, 1)}
                self.rows.append((a, entries, 0.0 if self.tied else G[a] / D, self.scene.thickness * D))
