"""space.py -- a pair in space for independent.py: facets that are affine images of their reference cells.

Each nonmortar facet has a plane, normal to the mean of its nodal normals; in it both facets are convex polygons. The corners
of their common part are enumerated: corners of one inside the other, and where edges cross. The part is integrated as the
sum of the triangles between one corner of the nonmortar facet and the part's edges, whose areas have signs; since
everything is a polynomial there, that is exact.
"""
import itertools

import numpy as np

from bodies import CORNERS, gauss
from contact import Pair, beside, frame, turning, unit

EXACT = 7  # Gauss points in each direction: to degree 12 in the plane
CLOSE = 1e-12  # of a facet's size


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def inside(polygon, p, size):
    """Whether a point lies in a convex polygon that runs anticlockwise, or on its rim."""
    return all(cross(b - a, p - a) >= -CLOSE * size * np.linalg.norm(b - a) for a, b in zip(polygon, np.roll(polygon, -1, axis=0)))


def crossing(a, b, c, d):
    """Where the edges a b and c d cross, or None."""
    det = cross(b - a, d - c)
    if abs(det) <= CLOSE * np.linalg.norm(b - a) * np.linalg.norm(d - c):
        return None
    s, t = cross(c - a, d - c) / det, cross(c - a, b - a) / det
    return a + s * (b - a) if 0 < s < 1 and 0 < t < 1 else None


def common(A, B, size):
    """Corners of what two convex polygons have in common, anticlockwise around their mean."""
    edges = [list(zip(P, np.roll(P, -1, axis=0))) for P in (A, B)]
    points = [p for p in A if inside(B, p, size)] + [p for p in B if inside(A, p, size)]
    points += [p for e, f in itertools.product(*edges) if (p := crossing(*e, *f)) is not None]
    if len(points) < 3:
        return []
    points = np.array(points)
    x, y = (points - points.mean(axis=0)).T
    return points[np.argsort(np.arctan2(y, x))]


class Plate:
    """A facet in a plane: corners anticlockwise, and the affine maps from there to its reference cell and to space."""

    def __init__(self, pair, facet, kind, shape, origin, Q):
        points = pair.scene.points[list(facet)]
        self.facet, self.shape, self.count = facet, shape, len(CORNERS[kind])
        self.begin, self.edges = points[0], np.column_stack([points[1] - points[0], points[self.count - 1] - points[0]])
        if np.abs(points - self.begin - shape.nodes @ self.edges.T).max() > 1e-10 * np.abs(self.edges).max():
            raise ValueError("a facet is not an affine image of its reference cell")
        self.flat = (points[:self.count] - origin) @ Q[1:].T
        self.inverse = np.linalg.inv(Q[1:] @ self.edges)
        self.gradient = np.linalg.pinv(self.edges)  # along the facet, from the one on the reference cell
        self.measure = np.linalg.norm(np.cross(*self.edges.T)) * abs(np.linalg.det(self.inverse))  # of space, by that of the plane

    def polygon(self):
        (a, b, c), rest = self.flat[:3], self.flat
        return rest if cross(b - a, c - a) > 0 else rest[::-1]

    def at(self, p):
        """Place on the reference facet, and in space, of what the plane shows at p."""
        place = self.inverse @ (p - self.flat[0])
        return place, self.begin + self.edges @ place


class SpacePair(Pair):
    """Where points of a side meet the other one along the normal of their facet's plane."""

    def read_obstacle(self, option):
        raise ValueError("no obstacles are known here in space")

    def set_normals(self):
        """Of a corner: the sum of e1 x e2 / (|e1|^2 |e2|^2) over the facets around it, with the edges that leave it (Max 1999).
        Of facets of order 2: the sum of their unit normals over what a facet measures at a node."""
        self.normal = {node: np.zeros(3) for node in self.nodes}
        corners = len(CORNERS[self.kind])
        for facet in self.facets:
            points = self.scene.points[list(facet)]
            for i, node in enumerate(facet):
                if len(facet) > corners:
                    area = np.cross(*(points.T @ self.shape.at(self.shape.nodes[i])[1]).T)
                    self.normal[node] += area / (area @ area)
                else:
                    e1, e2 = points[(i + 1) % corners] - points[i], points[i - 1] - points[i]
                    self.normal[node] += np.cross(e1, e2) / ((e1 @ e1) * (e2 @ e2))

    def rays(self, facet):
        n = unit(sum(self.normal[node] for node in facet))
        origin, Q = self.scene.points[list(facet)].mean(axis=0), frame(n)
        mine = Plate(self, facet, self.kind, self.shape, origin, Q)
        size, fan = np.abs(mine.flat).max(), mine.flat[0]
        for other in self.mortar:
            theirs = Plate(self, other, self.mortar_body.facet_kind, self.mortar_body.facet_shape, origin, Q)
            if np.cross(*theirs.edges.T) @ n >= 0:
                continue
            part = common(mine.polygon(), theirs.polygon(), size)
            for a, b in zip(part, np.roll(part, -1, axis=0)):
                area = cross(a - fan, b - fan)
                for (r, v), (s, w) in itertools.product(zip(*gauss(EXACT)), repeat=2) if area else ():
                    p = fan + r * ((1 - s) * (a - fan) + s * (b - fan))
                    place, x = mine.at(p)
                    eta, y = theirs.at(p)
                    phi, slopes = theirs.shape.at(eta)
                    yield place, v * w * r * area * mine.measure, (y - x) @ n, dict(zip(other, phi)), self.more_at(x, y, theirs, dict(zip(other, slopes @ theirs.gradient)))

    def more_at(self, x, y, theirs, gradients):
        n = unit(np.cross(*theirs.edges.T))
        return turning(x - y, n, gradients) if self.tied else lambda along: beside(x, y, n, along, gradients)
