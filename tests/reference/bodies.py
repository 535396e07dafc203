"""bodies.py -- mapped boxes of order 1 or 2, in the plane or in space, for independent.py: nodes, cells, sides, Hooke's law.

Shape functions are not written down: they are the combinations of monomials that are 1 at their node and 0 at the others.
"""
import itertools
import math

import numpy as np

KNOWN = {word: getattr(np, word) for word in ("sin", "cos", "sinh", "cosh", "exp", "sqrt", "pi")} | {"_pi": np.pi, "free": np.nan}
MANY = 8  # Gauss points of a piece, where a finite number is exact enough but not exact


def evaluate(text, *x):
    """The comma list of expressions at a point, or at arrays of points: [component] or [component][point]."""
    value = eval(text.replace("^", "**"), KNOWN, dict(zip("xyz", x)))  # pylint: disable=eval-used
    return np.array([v + 0.0 * x[0] for v in (value if isinstance(value, tuple) else (value,))])


def names(text):
    return [word.strip() for word in text.split(",") if word.strip()]


def numbers(text):
    return [float(word) for word in text.split(",")]


def gauss(count):
    points, weights = np.polynomial.legendre.leggauss(count)
    return 0.5 * (1 + points), 0.5 * weights


# --- cells ------------------------------------------------------------------------------------------------------------


class Shape:
    """phi_i = sum_m c_mi prod_k s_k^p_mk with phi_i(node_j) = delta_ij."""

    def __init__(self, nodes, powers):
        self.nodes, self.powers = np.array(nodes, dtype=float), np.array(powers)
        self.coefficients = np.linalg.inv(np.prod(self.nodes[:, None, :] ** self.powers, axis=-1))

    def at(self, point):
        """phi [n] and its derivatives [n][dim] at a point of the reference cell."""
        p, s = self.powers, np.asarray(point, dtype=float)
        terms, slopes = s ** p, p * s ** np.maximum(p - 1, 0)
        others = [np.delete(terms, k, axis=1).prod(axis=1) for k in range(len(s))]
        return terms.prod(axis=1) @ self.coefficients, self.coefficients.T @ (slopes * np.column_stack(others))


KINDS = {1: ("line", "line"), 2: ("quad", "triangle"), 3: ("hex", "tet")}  # [dim]: as it comes from a lattice, cut into simplices
DIM = {kind: dim for dim, kinds in KINDS.items() for kind in kinds}
CORNERS = {"line": [(0,), (1,)], "triangle": [(0, 0), (1, 0), (0, 1)], "quad": [(0, 0), (1, 0), (1, 1), (0, 1)],
           "tet": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], "hex": list(itertools.product((0, 1), repeat=3))}
# In the order of XDMF's cells, by which other programs of the tests read files.
MIDDLES = {"triangle": [(0.5, 0), (0.5, 0.5), (0, 0.5)], "quad": [(0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5), (0.5, 0.5)]}


def is_simplex(kind):
    return kind in ("triangle", "tet")


def shape_of(kind, order):
    """Corners, then the other nodes of a lattice with `order` steps; powers up to order, of each factor or of all together."""
    lattice = [place for place in itertools.product(range(order + 1), repeat=DIM[kind]) if not is_simplex(kind) or sum(place) <= order]
    others = [place for place in (tuple(step / order for step in steps) for steps in lattice) if place not in CORNERS[kind]]
    return Shape(CORNERS[kind] + (MIDDLES.get(kind, others) if order == 2 else []), lattice)


SHAPES = {(kind, order): shape_of(kind, order) for kind in DIM for order in (1, 2)}


def kuhn(dim):
    """Corners of the parts of a lattice cell that go from its lowest corner to its highest one, as columns after the lowest."""
    for axes in itertools.permutations(range(dim)):
        columns = np.cumsum(np.eye(dim)[list(axes)], axis=0).T
        yield columns if np.linalg.det(columns) > 0 else columns[:, [1, 0, *range(2, dim)]]


PARTS = {kind: list(kuhn(DIM[kind])) if is_simplex(kind) else [np.eye(DIM[kind])] for kind in DIM}


def cut(lattice, kind, order):
    """The cells of a lattice of nodes, as it is or each cut in parts."""
    for corner in itertools.product(*(range(0, count - 1, order) for count in lattice.shape)):
        for columns in PARTS[kind]:
            places = np.round(order * SHAPES[kind, order].nodes @ columns.T).astype(int) + corner
            yield lattice[tuple(places.T)]


def triangle_rule():
    """Six points of degree 4, two orbits (Dunavant 1985) with points and weights in closed form."""
    rule = []
    for sign in (1, -1):
        a = (8 - math.sqrt(10) + sign * math.sqrt(38 - 44 * math.sqrt(0.4))) / 18
        weight = (620 + sign * math.sqrt(213125 - 53320 * math.sqrt(10))) / 7440
        rule += [((s, t), weight) for s, t in ((a, a), (1 - 2 * a, a), (a, 1 - 2 * a))]
    return rule


def product_rule(kind, count):
    """count^dim Gauss points, pushed together towards a corner in a simplex: s, (1 - s) t, (1 - s) (1 - t) r."""
    rule = []
    for place in itertools.product(zip(*gauss(count)), repeat=DIM[kind]):
        point, weight, rest = [], math.prod(w for _, w in place), 1.0
        for k, (s, _) in enumerate(place):
            point.append(rest * s)
            if is_simplex(kind):
                weight *= (1 - s) ** (len(place) - 1 - k)
                rest *= 1 - s
        rule.append((tuple(point), weight))
    return rule


def cell_rule(kind, order):
    """The rule that defines the stiffness, exact on straight cells: (order + 1)^dim Gauss points, 6 in a triangle of order 2."""
    if kind == "triangle" and order == 2:
        return triangle_rule()
    if is_simplex(kind) and order == 1:
        return [((1 / (DIM[kind] + 1),) * DIM[kind], 1 / math.factorial(DIM[kind]))]
    return product_rule(kind, order + 1)


def normal_of(tangents):
    """The normal of a facet, its length the measure: (dy, -dx) of a line, the cross product of two. [in] tangents - [dim][dim-1]"""
    return np.array([tangents[1, 0], -tangents[0, 0]]) if len(tangents) == 2 else np.cross(*tangents.T)


# --- Hooke's law ------------------------------------------------------------------------------------------------------


def isotropic(young, poisson, model):
    """c_ijkl = lambda d_ij d_kl + mu (d_ik d_jl + d_il d_jk) in space, and what a plate makes of it."""
    one = np.eye(3)
    lam, mu = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))
    c = lam * np.einsum("ij,kl->ijkl", one, one) + mu * (np.einsum("ik,jl->ijkl", one, one) + np.einsum("il,jk->ijkl", one, one))
    if model == "solid":
        return c
    plane = c[:2, :2, :2, :2]
    if model == "plane_stress":  # the strain along z that makes the stress along z vanish
        plane = plane - np.einsum("ij,kl->ijkl", c[:2, :2, 2, 2], c[2, 2, :2, :2]) / c[2, 2, 2, 2]
    return plane


VOIGT = {2: np.array([[0, 2], [2, 1]]), 3: np.array([[0, 5, 4], [5, 1, 3], [4, 3, 2]])}  # xx,yy,xy; xx,yy,zz,yz,xz,xy


def turn(axis, degrees):
    """Rotation about an axis of space."""
    angle, R = math.radians(degrees), np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R[[i, j], [i, j]], R[i, j], R[j, i] = math.cos(angle), -math.sin(angle), math.sin(angle)
    return R


def anisotropic(upper, degrees):
    """c_ijkl of 6 or 21 numbers (upper triangle by rows), turned: c'_ijkl = R_ip R_jq R_kr R_ls c_pqrs; R about z, or z, x, z."""
    dim = 2 if len(upper) == 6 else 3
    voigt, c = np.zeros((3 * dim - 3,) * 2), np.zeros((dim,) * 4)
    voigt[np.triu_indices(len(voigt))] = upper
    voigt = voigt + np.triu(voigt, 1).T
    row = VOIGT[dim]
    for i, j, k, l in np.ndindex(c.shape):
        c[i, j, k, l] = voigt[row[i, j], row[k, l]]
    R = np.linalg.multi_dot([turn(axis, angle) for axis, angle in zip((2, 0, 2), [*degrees, 0, 0])])[:dim, :dim]
    return np.einsum("ip,jq,kr,ls,pqrs->ijkl", R, R, R, R, c)


# --- one body ---------------------------------------------------------------------------------------------------------

SIDES = {2: {"left": (0, 0), "right": (0, 1), "bottom": (1, 0), "top": (1, 1)},  # axis, and at which end of it
         3: {"left": (0, 0), "right": (0, 1), "front": (1, 0), "back": (1, 1), "bottom": (2, 0), "top": (2, 1)}}


class Body:
    """A mapped box: points, cells (right-handed), sides as lists of facets whose normals point out, Hooke's tensor.

    Its nodes are a lattice with `order` steps per cell; a facet has its corners, then its other nodes, in the scene's numbering.
    """

    def __init__(self, name, options, first):
        self.name, self.options, self.first = name, options, first
        self.order = int(self.asked("order", options.get("order", "1")))
        steps = [int(n) * self.order for n in numbers(self.asked("dm_plex_box_faces"))]
        self.dim = len(steps)
        ends = [numbers(self.asked(f"dm_plex_box_{end}", ",".join(default * self.dim))) for end, default in (("lower", "0"), ("upper", "1"))]
        grid = np.meshgrid(*(np.linspace(a, b, n + 1) for a, b, n in zip(*ends, steps)), indexing="ij")
        self.points = evaluate(self.asked("map", ",".join("xyz"[:self.dim])), *(axis.ravel() for axis in grid)).T
        simplex = self.asked("dm_plex_simplex", "1") == "1"
        self.kind, self.facet_kind = KINDS[self.dim][simplex], KINDS[self.dim - 1][simplex]
        self.shape, self.rule = SHAPES[self.kind, self.order], cell_rule(self.kind, self.order)
        self.facet_shape = SHAPES[self.facet_kind, self.order]
        lattice = np.arange(len(self.points)).reshape([n + 1 for n in steps])
        self.cells = list(cut(lattice, self.kind, self.order))
        self.sides = {side: [tuple(facet.tolist()) for facet in cut(first + self.skin(lattice, *place), self.facet_kind, self.order)]
                      for side, place in SIDES[self.dim].items()}
        self.polygonal = self.asked("polygonal", "0") == "1"
        self.set_material()

    def asked(self, key, default=None):
        value = self.options.pop(f"{self.name}_{key}", default)
        if value is None:
            raise KeyError(f"-{self.name}_{key}")
        return value

    @staticmethod
    def skin(lattice, axis, end):
        """One end of a lattice; its own axes run so that the normal of what they span points out."""
        face = np.take(lattice, -end, axis=axis)
        if (-1) ** axis == (1 if end else -1):
            return face
        return face[::-1] if face.ndim == 1 else face.T

    def set_material(self):
        self.pressures = np.zeros((0, self.dim))
        model = self.options.get("model", "plane_strain")
        if f"{self.name}_stiffness" in self.options:
            self.hooke, self.zz = anisotropic(numbers(self.asked("stiffness")), numbers(self.asked("material_angle", "0"))), None
        else:
            young, poisson = float(self.asked("young")), float(self.asked("poisson"))
            self.hooke, self.zz = isotropic(young, poisson, model), poisson if model == "plane_strain" else 0.0
            self.set_volume(young / 3 / (1 - 2 * poisson), poisson, model)

    def set_volume(self, bulk, poisson, model):
        """Where cells would lock: pressures of the cell, powers of x, and Hooke's tensor of a body that has no bulk modulus."""
        if model == "plane_stress" or poisson <= (0.45, 0.49)[self.order - 1]:
            return
        if is_simplex(self.kind) and (self.order, self.dim) != (2, 2):
            raise ValueError("these cells lock")
        one = np.eye(self.dim)
        linear = self.order == 2 and not is_simplex(self.kind)
        self.bulk, self.hooke, self.zz = bulk, self.hooke - bulk * np.einsum("ij,kl->ijkl", one, one), -1.0  # what is left has no trace
        self.pressures = np.vstack([0 * one[:1], one]) if linear else 0 * one[:1]

    def functions(self, cell, phi):
        """The pressures q of a cell at a point."""
        return np.prod((phi @ self.points[cell] - self.points[cell].mean(axis=0)) ** self.pressures, axis=1)

    def volume(self, cell):
        """int q q' and int q div of a cell."""
        mass, divergence = 0.0, 0.0
        for at, weight in self.rule:
            phi, grad, det = self.gradients(cell, at)
            q = self.functions(cell, phi)
            mass, divergence = mass + weight * det * np.outer(q, q), divergence + weight * det * np.outer(q, grad.ravel())
        return mass, divergence

    def gradients(self, cell, at):
        """Shape functions, their gradients [n][dim] and det J at a point of the reference cell."""
        phi, slopes = self.shape.at(at)
        J = self.points[cell].T @ slopes
        return phi, slopes @ np.linalg.inv(J), np.linalg.det(J)

    def surface(self, points):
        """Gauss points of a facet: shape functions and outward normals, whose length is the weight. [in] points - of its nodes"""
        for at, weight in product_rule(self.facet_kind, MANY):
            phi, slopes = self.facet_shape.at(at)
            yield phi, weight * normal_of(points.T @ slopes)
