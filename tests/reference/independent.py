#!/usr/bin/env python3
"""independent.py -- solves the scenes of this folder without mortise: numpy and dense matrices, nothing else.

    python3 independent.py [case ...]            writes <case>/nodes.csv, <case>/<pair>.csv, <case>/ORIGIN (all cases by default)
    python3 independent.py --check [case ...]    computes the same and compares with what is there

What it shares with the program is the mathematics (src/THEORY.md), not the way: Hooke's law stays a tensor of fourth rank; a
nonmortar facet is cut at all places from which some mortar node is seen, and every piece looks for the facet that its
middle ray meets; nothing is condensed, the saddle point system (T3) is solved as it stands; and the contact set is found by
Murty's least index method on the dual problem, which changes one node at a time and provably ends.
It knows boxes of quads or triangles, maps, and what the scenes here need of the options; anything else is an error.

Reference: K. G. Murty, Note on a Bard-type scheme for solving the complementarity problem, Opsearch 11 (1974).
"""
import math
import pathlib
import shlex
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
SLIVER, NOTHING, HELD = 1e-3, 1e-13, 0.1  # a node with less cover or less freedom carries no multiplier (THEORY 7)
OPEN, CONTACT, TIED, NONE = 0, 1, 2, -1  # status of a node in the tables
CHECKED = 1e-11  # of the largest value of a column: what two runs of this program may differ by on two machines


def read_scene(path):
    """The options of a file as {name without dash: text}; asked() removes what was read, so that leftovers are noticed."""
    options = {}
    for line in path.read_text().splitlines():
        words = shlex.split(line, comments=True)
        if words:
            options[words[0][1:]] = " ".join(words[1:])
    return options


def numbers(text):
    return [float(word) for word in text.split(",")]


def names(text):
    return [word.strip() for word in text.split(",") if word.strip()]


# --- one body ---------------------------------------------------------------------------------------------------------


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


class Body:
    """A mapped box: points, cells (anticlockwise), sides as chains of edges with the body on their left, Hooke's tensor."""

    def __init__(self, name, options, first):
        self.name, self.options, self.first = name, options, first
        nx, ny = (int(n) for n in numbers(self.asked("dm_plex_box_faces")))
        lower, upper = numbers(self.asked("dm_plex_box_lower", "0,0")), numbers(self.asked("dm_plex_box_upper", "1,1"))
        x, y = np.linspace(lower[0], upper[0], nx + 1), np.linspace(lower[1], upper[1], ny + 1)
        self.points = self.mapped(np.array([(s, t) for t in y for s in x]), self.asked("map", "x, y"))
        corners = [(a, a + 1, a + nx + 2, a + nx + 1) for j in range(ny) for a in range(j * (nx + 1), j * (nx + 1) + nx)]
        simplex = self.asked("dm_plex_simplex", "1") == "1"
        self.cells = [cell for a, b, c, d in corners for cell in (((a, b, c), (a, c, d)) if simplex else ((a, b, c, d),))]
        rows, columns = (nx + 1) * np.arange(ny + 1), np.arange(nx + 1)
        chain = {"bottom": columns, "right": rows + nx, "top": columns[::-1] + rows[-1], "left": rows[::-1]}
        self.sides = {side: list(zip(nodes[:-1] + first, nodes[1:] + first)) for side, nodes in chain.items()}
        self.set_material()

    def asked(self, key, default=None):
        value = self.options.pop(f"{self.name}_{key}", default)
        if value is None:
            raise KeyError(f"-{self.name}_{key}")
        return value

    @staticmethod
    def mapped(points, text):
        known = {word: getattr(np, word) for word in ("sin", "cos", "sinh", "exp", "sqrt")}
        x, y = eval(text.replace("^", "**"), known, {"x": points[:, 0], "y": points[:, 1]})  # pylint: disable=eval-used
        return np.column_stack([x, y])

    def set_material(self):
        model = self.options.get("model", "plane_strain")
        if f"{self.name}_stiffness" in self.options:
            self.hooke, self.zz = anisotropic(numbers(self.asked("stiffness")), float(self.asked("material_angle", "0"))), None
        else:
            young, poisson = float(self.asked("young")), float(self.asked("poisson"))
            self.hooke, self.zz = isotropic(young, poisson, model), poisson if model == "plane_strain" else 0.0

    def gradients(self, cell, at):
        """Shape functions, their gradients [n][2] and det J at a point of the reference cell."""
        s, t = at
        if len(cell) == 3:
            phi, d = np.array([1 - s - t, s, t]), np.array([[-1, -1], [1, 0], [0, 1]])
        else:
            phi = np.array([(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t])
            d = np.array([[t - 1, s - 1], [1 - t, -s], [t, s], [-t, 1 - s]])
        J = self.points[list(cell)].T @ d
        return phi, d @ np.linalg.inv(J), np.linalg.det(J)

    @staticmethod
    def rule(cell):
        """The rule that defines the stiffness: middle of a triangle, 2 x 2 Gauss points of a quad; and weights."""
        if len(cell) == 3:
            return [((1 / 3, 1 / 3), 0.5)]
        g = 0.5 / math.sqrt(3)
        return [((0.5 + a, 0.5 + b), 0.25) for a in (-g, g) for b in (-g, g)]


# --- all bodies: K u = f and supports ---------------------------------------------------------------------------------


class Scene:
    """The discrete problem (T3) of an options file as dense arrays; unknown 2 a + k is component k at node a."""

    def __init__(self, path):
        self.options = read_scene(path)
        self.bodies, first = {}, 0
        self.title = self.options.pop("title", "")
        for name in names(self.options.pop("bodies")):
            self.bodies[name] = Body(name, self.options, first)
            first += len(self.bodies[name].points)
        self.plane_stress = self.options.pop("model", "plane_strain") == "plane_stress"
        self.thickness = float(self.options.pop("thickness", "1"))
        self.points = np.vstack([body.points for body in self.bodies.values()])
        self.body = np.concatenate([np.full(len(body.points), b) for b, body in enumerate(self.bodies.values())])
        self.K, self.f, self.held = np.zeros((2 * first, 2 * first)), np.zeros(2 * first), {}
        for body in self.bodies.values():
            self.add_cells(body)
            self.add_loads(body)
            self.add_supports(body)
        self.pairs = [Pair(name, self) for name in names(self.options.pop("pairs", ""))]
        if self.options:
            raise ValueError(f"options that are not known here: {', '.join(self.options)}")

    def add_cells(self, body):
        force = np.array(numbers(body.asked("body_force", "0,0")))
        for cell in body.cells:
            dofs = np.array([[2 * (body.first + a), 2 * (body.first + a) + 1] for a in cell]).ravel()
            for at, weight in body.rule(cell):
                phi, grad, det = body.gradients(cell, at)
                if det <= 0:
                    raise ValueError("a cell is tangled")
                part = np.einsum("aj,ijkl,bl->aibk", grad, body.hooke, grad).reshape(len(dofs), -1)
                self.K[np.ix_(dofs, dofs)] += self.thickness * weight * det * part
                self.f[dofs] += self.thickness * weight * det * np.outer(phi, force).ravel()

    def edge(self, a, b):
        """Length and outward normal of an edge whose body lies on the left."""
        along = self.points[b] - self.points[a]
        length = math.hypot(*along)
        return length, np.array([along[1], -along[0]]) / length

    def add_loads(self, body):
        """Constant tractions and pressures: half of each edge's force to each of its ends."""
        for kind in ("traction", "pressure"):
            for side in names(body.asked(f"bc_{kind}", "")):
                value = numbers(body.asked(f"bc_{kind}_{side}"))
                for a, b in body.sides[side]:
                    length, normal = self.edge(a, b)
                    force = np.array(value) if kind == "traction" else -value[0] * normal
                    for node in (a, b):
                        self.f[[2 * node, 2 * node + 1]] += 0.5 * self.thickness * length * force

    def add_supports(self, body):
        """Fills held: {unknown: value}. Sides with normal supports have to lie along an axis."""
        for side in names(body.asked("bc_displacement", "")):
            for k, word in enumerate(names(body.asked(f"bc_displacement_{side}"))):
                for node in {node for edge in body.sides[side] for node in edge} if word != "free" else ():
                    self.held[2 * node + k] = float(word)
        for side in names(body.asked("bc_normal", "")):
            _, normal = self.edge(body.sides[side][0][0], body.sides[side][-1][1])
            k = int(np.argmax(np.abs(normal)))
            if abs(normal[1 - k]) > 1e-12:
                raise ValueError(f"side {side} of {body.name} is not along an axis")
            for node in {node for edge in body.sides[side] for node in edge}:
                self.held[2 * node + k] = 0.0

    def side(self, text):
        body, side = text.split(":")
        return self.bodies[body].sides[side]


# --- one pair ---------------------------------------------------------------------------------------------------------


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


class Pair:
    """D, M, G of (T4), (T5), and from them the rows of B with one multiplier each."""

    def __init__(self, name, scene):
        self.name, self.scene = name, scene
        option = lambda key, default=None: scene.options.pop(f"{name}_{key}", default)
        self.edges, mortar = scene.side(option("nonmortar")), option("mortar")
        self.mortar = scene.side(mortar) if mortar else None
        self.tied = option("type", "contact") == "tied"
        gap, self.offset = option("gap"), float(option("gap_offset", "0"))
        self.gap = None if gap is None else float(gap)
        option("reach")  # everything here is within reach
        if not mortar:
            self.parabola = self.read_parabola(option)
        self.nodes = list(dict.fromkeys(node for edge in self.edges for node in edge))
        self.set_normals()
        self.integrate()
        self.set_rows()

    @staticmethod
    def read_parabola(option):
        """The rigid parabola above y = y_0 + (x - x_0)^2 / (2 R), pointing down."""
        if option("obstacle") != "parabola" or numbers(option("obstacle_normal")) != [0.0, -1.0]:
            raise ValueError("the only obstacle here is a parabola that points down")
        return (*numbers(option("obstacle_point")), float(option("obstacle_radius")))

    def set_normals(self):
        """(T13), the prescribed directions taken out."""
        self.normal = {node: np.zeros(2) for node in self.nodes}
        for a, b in self.edges:
            length, normal = self.scene.edge(a, b)
            self.normal[a] += normal / length
            self.normal[b] += normal / length
        self.normal = {node: n / math.hypot(*n) for node, n in self.normal.items()}
        self.free = {}
        for node, n in self.normal.items():
            part = np.array([0.0 if 2 * node + k in self.scene.held else n[k] for k in (0, 1)])
            self.free[node] = math.hypot(*part)
            if self.free[node] >= HELD:
                self.normal[node] = part / self.free[node]

    def cuts(self, x, n):
        """Where on a facet x(s) some mortar node y lies on the ray: cross(x(s) - y, n(s)) = 0, quadratic in s."""
        dx, dn, found = x[1] - x[0], n[1] - n[0], {0.0, 1.0}
        for y in self.scene.points[sorted({node for edge in self.mortar for node in edge})]:
            equation = [cross(dx, dn), cross(x[0] - y, dn) + cross(dx, n[0]), cross(x[0] - y, n[0])]
            if abs(equation[0]) < 1e-14 * abs(equation[1]):
                equation = equation[1:]
            found.update(float(s.real) for s in np.roots(equation) if abs(s.imag) < 1e-12 and 0 < s.real < 1)
        found = sorted(found)
        return [s for i, s in enumerate(found) if i == 0 or s - found[i - 1] > 1e-12]

    def meet(self, x, n, edges):
        """The ray x + t n and the mortar side: (|t|, t, s, edge) of the nearest edge that faces it; None if there is none."""
        hits = []
        for a, b in edges:
            y, z = self.scene.points[a], self.scene.points[b]
            if self.scene.edge(a, b)[1] @ n < -0.3:
                t, s = np.linalg.solve(np.column_stack([n, y - z]), y - x)
                if -1e-9 <= s <= 1 + 1e-9:
                    hits.append((abs(t), t, s, (a, b)))
        return min(hits, default=None)

    def rays(self, x, n):
        """Gauss points of one facet: s on it, weight, gap, and {mortar node: shape function}."""
        turns = np.abs(n[1] - n[0]).max() > 1e-12
        gauss, weights = np.polynomial.legendre.leggauss(4 if turns or not self.mortar else 2)
        ends = self.cuts(x, n) if self.mortar else [0.0, 1.0]
        at = lambda s: ((1 - s) * x[0] + s * x[1], (1 - s) * n[0] + s * n[1])
        unit = lambda v: v / math.hypot(*v)
        for begin, end in zip(ends[:-1], ends[1:]):
            middle, direction = at(0.5 * (begin + end))
            seen = self.meet(middle, unit(direction), self.mortar) if self.mortar else True
            for g, w in zip(gauss, weights) if seen else ():
                s = begin + 0.5 * (1 + g) * (end - begin)
                point, direction = at(s)
                if not self.mortar:
                    yield s, 0.5 * w, self.parabola[1] + (point[0] - self.parabola[0])**2 / (2 * self.parabola[2]) - point[1], {}
                    continue
                _, gap, eta, edge = self.meet(point, unit(direction), [seen[3]])
                yield s, 0.5 * w * (end - begin), gap, {edge[0]: 1 - eta, edge[1]: eta}

    def integrate(self):
        """D, M, G per node; psi from the biorthogonality (T6) on what is covered."""
        self.D, self.G, self.M = ({node: zero for node in self.nodes} for zero in (0.0, 0.0, None))
        self.M, self.full, self.beside = {node: {} for node in self.nodes}, dict(self.D), {node: set() for node in self.nodes}
        for edge in self.edges:
            length, _ = self.scene.edge(*edge)
            rays = list(self.rays(self.scene.points[list(edge)], [self.normal[node] for node in edge]))
            for node in edge:
                self.full[node] += 0.5 * length
            if not rays:
                continue
            s, w = np.array([ray[0] for ray in rays]), np.array([ray[1] for ray in rays]) * length
            phi = np.array([1 - s, s])
            psi = np.diag(phi @ w) @ np.linalg.solve((phi * w) @ phi.T, phi)
            for i, node in enumerate(edge):
                self.beside[node].add(edge[1 - i])
                self.D[node] += w @ phi[i]
                for (_, _, gap, mortar), weight, value in zip(rays, w, psi[i]):
                    self.G[node] += weight * value * ((gap if self.gap is None else self.gap) + self.offset)
                    for b, shape in mortar.items():
                        self.M[node][b] = self.M[node].get(b, 0.0) + weight * value * shape

    def keeps(self, node):
        """Whether a node carries its multiplier."""
        held = any(2 * node + k in self.scene.held for k in (0, 1))
        return self.D[node] >= SLIVER * self.full[node] and self.free[node] >= HELD and not (self.tied and held)

    def set_rows(self):
        """Rows of B as {unknown: value} over D_aa; rows of removed nodes go to their kept neighbours (T12)."""
        self.kept = [node for node in self.nodes if self.D[node] > NOTHING * self.full[node] and self.keeps(node)]
        removed = [node for node in self.nodes if self.D[node] > NOTHING * self.full[node] and node not in self.kept]
        self.chain, self.share = {node: {} for node in self.kept}, {}
        M, G = {node: dict(self.M[node]) for node in self.kept}, {node: self.G[node] for node in self.kept}
        for c in removed:
            self.share[c] = [a for a in self.kept if a in self.beside[c]]
            for a in self.share[c]:
                w = 1.0 / len(self.share[c])
                self.chain[a][c] = w * self.D[c]
                G[a] += w * self.G[c]
                for b, value in self.M[c].items():
                    M[a][b] = M[a].get(b, 0.0) + w * value
        self.weight = {a: self.scene.thickness * (self.D[a] + sum(self.chain[a].values())) for a in self.kept}
        self.rows = []
        for a in self.kept:
            n, D = self.normal[a], self.D[a]
            nodes = {a: 1.0, **{c: value / D for c, value in self.chain[a].items()}, **{b: -value / D for b, value in M[a].items()}}
            for direction in (n, np.array([-n[1], n[0]])) if self.tied else (n,):
                row = {2 * b + k: value * direction[k] for b, value in nodes.items() for k in (0, 1)}
                self.rows.append((a, row, 0.0 if self.tied else G[a] / D, self.scene.thickness * D))


# --- the solution -----------------------------------------------------------------------------------------------------


def least_index(S, q):
    """The set of p > 0 in  w = S p - q >= 0, p >= 0, p w = 0,  S symmetric positive definite (Murty 1974)."""
    inside = np.zeros(len(q), dtype=bool)
    tiny_p, tiny_w = 1e-12 * np.abs(q / np.diag(S)).max(initial=0), 1e-12 * np.abs(q).max(initial=0)
    for _ in range(100000):
        p = np.zeros(len(q))
        p[inside] = np.linalg.solve(S[np.ix_(inside, inside)], q[inside])
        wrong = np.where(inside, p < -tiny_p, S @ p - q < -tiny_w)
        if not wrong.any():
            return inside
        inside[np.argmax(wrong)] ^= True
    raise ArithmeticError("no end")


def solve_refined(A, b):
    """A x = b, the residual taken twice more in extended precision."""
    inverse, x = np.linalg.inv(A), np.zeros(len(b), dtype=np.longdouble)
    for _ in range(4):
        x = x + inverse @ np.asarray(b - A.astype(np.longdouble) @ x, dtype=float)
    return x.astype(float)


class Solution:
    """u [nodes][2] and, per row of all pairs, multiplier p, gap left and status."""

    def __init__(self, scene):
        self.scene = scene
        size, self.rows = len(scene.f), [(pair, *row) for pair in scene.pairs for row in pair.rows]
        stiffness = np.diag(scene.K).max()
        free = np.array([i for i in range(size) if i not in scene.held])
        u = np.zeros(size)
        for i, value in scene.held.items():
            u[i] = value
        B = np.zeros((len(self.rows), size))
        for r, (_, _, row, _, _) in enumerate(self.rows):
            B[r, list(row)] = list(row.values())
        g, tied = np.array([row[3] for row in self.rows]) - B @ u, np.array([row[0].tied for row in self.rows], dtype=bool)
        K, f = scene.K[np.ix_(free, free)] / stiffness, (scene.f - scene.K @ u)[free] / stiffness
        held = self.choose(K, f, B[:, free], g, tied)
        H, b = self.saddle(K, f, B[:, free], g, held)
        x = solve_refined(H, b)
        u[free] = x[:len(free)]
        forces = np.zeros(len(self.rows))
        forces[held] = stiffness * x[len(free):]
        self.u, self.p = u.reshape(-1, 2), forces / np.array([row[4] for row in self.rows])
        self.gap = np.array([row[3] for row in self.rows]) - B @ u
        self.status = np.where(tied, TIED, np.where(held, CONTACT, OPEN))
        self.judge(scene.K, scene.f, B, forces, free)

    @staticmethod
    def saddle(K, f, B, g, rows):
        """[K B'; B 0] and (f, g) with some rows of B."""
        C, zero = B[rows], np.zeros((np.count_nonzero(rows),) * 2)
        return np.block([[K, C.T], [C, zero]]), np.concatenate([f, g[rows]])

    def choose(self, K, f, B, g, tied):
        """The rows that hold as equations: ties, and the contacts that the dual problem finds."""
        H, b = self.saddle(K, f, B, g, tied)
        C = np.hstack([B[~tied], np.zeros((np.count_nonzero(~tied), np.count_nonzero(tied)))])
        S = C @ np.linalg.solve(H, C.T)
        held = tied.copy()
        held[~tied] = least_index(0.5 * (S + S.T), C @ np.linalg.solve(H, b) - g[~tied])
        return held

    def judge(self, K, f, B, forces, free):
        """Residuals of (T3) for ORIGIN, and how far the set is from a tie."""
        residual, size = (K @ self.u.ravel() + B.T @ forces - f)[free], np.abs(K @ self.u.ravel()).max()
        contact = self.status != TIED
        reach = max(np.abs(self.u).max(), 1e-300)
        p, gap = self.p[contact] / np.abs(self.p).max(), self.gap[contact] / reach
        self.report = {"equilibrium, of the largest force": np.abs(residual).max() / size,
                       "lowest pressure (negative: tension), of the largest": p.min(initial=0.0),
                       "lowest gap (negative: overlap), of the largest displacement": gap.min(initial=0.0),
                       "distance from a tie (smallest p or gap of a node)": (p + gap).min(initial=1.0)}

    def nodes(self):
        """Table of all nodes, sorted by coordinates."""
        order = np.lexsort([self.scene.body, *np.round(self.scene.points, 9).T[::-1]])
        columns = {"body": self.scene.body, "x": self.scene.points[:, 0], "y": self.scene.points[:, 1], "u_x": self.u[:, 0], "u_y": self.u[:, 1]}
        return {name: [value.item() for value in values[order]] for name, values in columns.items()}

    def side(self, pair):
        """Table of a nonmortar side, sorted by coordinates; nodes without multiplier have gap nan, status -1."""
        found = {}
        for r, (owner, node, *_) in enumerate(self.rows):
            if owner is pair and node not in found:  # the first row of a tied node is the normal one
                found[node] = (self.p[r], self.gap[r], int(self.status[r]), self.p[r] * pair.weight[node])
        for c, share in pair.share.items():
            found[c] = (sum(found[a][0] for a in share) / max(len(share), 1), math.nan, NONE, 0.0)
        nodes = sorted(pair.nodes, key=lambda node: tuple(np.round(self.scene.points[node], 9)))
        rows = [(*self.scene.points[node], *found.get(node, (0.0, math.nan, NONE, 0.0))) for node in nodes]
        return {name: [row[k] for row in rows] for k, name in enumerate(("x", "y", "p", "gap", "active", "force"))}


if __name__ == "__main__":
    from tables import main

    main(sys.argv[1:])
