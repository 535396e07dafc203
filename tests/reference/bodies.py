"""bodies.py -- mapped boxes of triangles or quads of order 1 or 2 for independent.py: nodes, cells, sides, Hooke's law.

Shape functions are not written down: they are the combinations of monomials that are 1 at their node and 0 at the others.
"""
import math

import numpy as np

KNOWN = {word: getattr(np, word) for word in ("sin", "cos", "sinh", "cosh", "exp", "sqrt", "pi")} | {"_pi": np.pi, "free": np.nan}


def evaluate(text, x, y):
    """The comma list of expressions at a point, or at arrays of points: [component] or [component][point]."""
    value = eval(text.replace("^", "**"), KNOWN, {"x": x, "y": y})  # pylint: disable=eval-used
    return np.array([v + 0.0 * x for v in (value if isinstance(value, tuple) else (value,))])


def names(text):
    return [word.strip() for word in text.split(",") if word.strip()]


def numbers(text):
    return [float(word) for word in text.split(",")]


# --- cells ------------------------------------------------------------------------------------------------------------


class Shape:
    """phi_i = sum_m c_mi s^p_m t^q_m with phi_i(node_j) = delta_ij."""

    def __init__(self, nodes, powers):
        self.nodes, self.powers = np.array(nodes, dtype=float), np.array(powers)
        self.coefficients = np.linalg.inv(np.prod(self.nodes[:, None, :] ** self.powers, axis=-1))

    def at(self, point):
        """phi [n] and its derivatives [n][2] at a point of the reference cell."""
        p, q = self.powers.T
        s, t = point
        slopes = np.column_stack([p * s ** np.maximum(p - 1, 0) * t ** q, q * t ** np.maximum(q - 1, 0) * s ** p])
        return (s ** p * t ** q) @ self.coefficients, self.coefficients.T @ slopes


CORNERS = {"triangle": [(0, 0), (1, 0), (0, 1)], "quad": [(0, 0), (1, 0), (1, 1), (0, 1)]}
MIDDLES = {"triangle": [(0.5, 0), (0.5, 0.5), (0, 0.5)], "quad": [(0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5), (0.5, 0.5)]}
SHAPES = {(kind, order): Shape(CORNERS[kind] + (MIDDLES[kind] if order == 2 else []),
                               [(p, q) for p in range(order + 1) for q in range(order + 1) if kind == "quad" or p + q <= order])
          for kind in CORNERS for order in (1, 2)}


def triangle_rule():
    """Six points of degree 4, two orbits (Dunavant 1985) with points and weights in closed form."""
    rule = []
    for sign in (1, -1):
        a = (8 - math.sqrt(10) + sign * math.sqrt(38 - 44 * math.sqrt(0.4))) / 18
        weight = (620 + sign * math.sqrt(213125 - 53320 * math.sqrt(10))) / 7440
        rule += [((s, t), weight) for s, t in ((a, a), (1 - 2 * a, a), (a, 1 - 2 * a))]
    return rule


def cell_rule(kind, order):
    """The rule that defines the stiffness, exact on straight cells: (order + 1)^2 Gauss points; 1 or 6 in a triangle."""
    if kind == "triangle":
        return triangle_rule() if order == 2 else [((1 / 3, 1 / 3), 0.5)]
    points, weights = np.polynomial.legendre.leggauss(order + 1)
    points, weights = 0.5 * (1 + points), 0.5 * weights
    return [((s, t), v * w) for s, v in zip(points, weights) for t, w in zip(points, weights)]


# --- Hooke's law ------------------------------------------------------------------------------------------------------


def isotropic(young, poisson, model):
    """c_ijkl = lambda d_ij d_kl + mu (d_ik d_jl + d_il d_jk) in space, and what a plate makes of it."""
    one = np.eye(3)
    lam, mu = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))
    c = lam * np.einsum("ij,kl->ijkl", one, one) + mu * (np.einsum("ik,jl->ijkl", one, one) + np.einsum("il,jk->ijkl", one, one))
    plane = c[:2, :2, :2, :2]
    if model == "plane_stress":  # the strain along z that makes the stress along z vanish
        plane = plane - np.einsum("ij,kl->ijkl", c[:2, :2, 2, 2], c[2, 2, :2, :2]) / c[2, 2, 2, 2]
    return plane


def anisotropic(upper, degrees):
    """c_ijkl of six numbers (xx,yy,xy, upper triangle by rows), turned: c'_ijkl = R_ip R_jq R_kr R_ls c_pqrs."""
    voigt, c = np.zeros((3, 3)), np.zeros((2, 2, 2, 2))
    voigt[np.triu_indices(3)] = upper
    voigt = voigt + np.triu(voigt, 1).T
    row = np.array([[0, 2], [2, 1]])
    for i, j, k, l in np.ndindex(2, 2, 2, 2):
        c[i, j, k, l] = voigt[row[i, j], row[k, l]]
    angle = math.radians(degrees)
    R = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    return np.einsum("ip,jq,kr,ls,pqrs->ijkl", R, R, R, R, c)


# --- one body ---------------------------------------------------------------------------------------------------------


class Body:
    """A mapped box: points, cells (anticlockwise), sides as chains of facets with the body on their left, Hooke's tensor.

    Its nodes are a lattice with `order` steps per cell; a facet is (end, end) or (end, end, middle) in the scene's numbering.
    """

    def __init__(self, name, options, first):
        self.name, self.options, self.first = name, options, first
        self.order = int(self.asked("order", options.get("order", "1")))
        nx, ny = (int(n) * self.order for n in numbers(self.asked("dm_plex_box_faces")))
        lower, upper = numbers(self.asked("dm_plex_box_lower", "0,0")), numbers(self.asked("dm_plex_box_upper", "1,1"))
        x, y = np.linspace(lower[0], upper[0], nx + 1), np.linspace(lower[1], upper[1], ny + 1)
        s, t = (axis.ravel() for axis in np.meshgrid(x, y))
        self.points = evaluate(self.asked("map", "x, y"), s, t).T
        self.kind = "triangle" if self.asked("dm_plex_simplex", "1") == "1" else "quad"
        self.shape, self.rule = SHAPES[self.kind, self.order], cell_rule(self.kind, self.order)
        lattice = np.arange((nx + 1) * (ny + 1)).reshape(ny + 1, nx + 1)
        self.cells = [cell for j in range(0, ny, self.order) for i in range(0, nx, self.order) for cell in self.cut(lattice, i, j)]
        chain = {"bottom": lattice[0], "right": lattice[:, -1], "top": lattice[-1, ::-1], "left": lattice[::-1, 0]}
        self.sides = {side: self.facets(first + nodes) for side, nodes in chain.items()}
        self.set_material()

    def asked(self, key, default=None):
        value = self.options.pop(f"{self.name}_{key}", default)
        if value is None:
            raise KeyError(f"-{self.name}_{key}")
        return value

    def cut(self, lattice, i, j):
        """The quad with its lower left corner at (i, j), or its two triangles, below and above the rising diagonal."""
        s, t = self.shape.nodes.T
        places = [(s, t)] if self.kind == "quad" else [(s + t, t), (s, s + t)]
        return [lattice[(j + self.order * q).astype(int), (i + self.order * p).astype(int)] for p, q in places]

    def facets(self, nodes):
        ends = zip(nodes[:-1:self.order], nodes[self.order::self.order])
        return [(*pair, *middle) for pair, middle in zip(ends, nodes[1::2, None] if self.order == 2 else [()] * len(nodes))]

    def set_material(self):
        model = self.options.get("model", "plane_strain")
        if f"{self.name}_stiffness" in self.options:
            self.hooke, self.zz = anisotropic(numbers(self.asked("stiffness")), float(self.asked("material_angle", "0"))), None
        else:
            young, poisson = float(self.asked("young")), float(self.asked("poisson"))
            self.hooke, self.zz = isotropic(young, poisson, model), poisson if model == "plane_strain" else 0.0

    def gradients(self, cell, at):
        """Shape functions, their gradients [n][2] and det J at a point of the reference cell."""
        phi, slopes = self.shape.at(at)
        J = self.points[cell].T @ slopes
        return phi, slopes @ np.linalg.inv(J), np.linalg.det(J)
