#!/usr/bin/env python3
"""independent.py -- solves the scenes of this folder without mortise: numpy and dense matrices, nothing else.

    python3 independent.py [case ...]            writes <case>/nodes.csv, <case>/<pair>.csv, <case>/ORIGIN (all cases by default)
    python3 independent.py --check [case ...]    computes the same and compares with what is there

What it shares with the program is the mathematics (src/THEORY.md), not the way: Hooke's law stays a tensor of fourth rank. A
nonmortar facet is cut at all places from which some mortar vertex is seen. Every piece looks for the facet that its middle ray
meets. Nothing is condensed: the saddle point system (eq. 3.1) is solved as it stands. The contact set is found by Murty's least
index method on the dual problem, which changes one node at a time and provably ends.
It knows boxes of order 1 or 2 in the plane and in space (bodies.py), maps and pairs (contact.py, space.py). Of the options it
knows what the scenes here need; anything else is an error.

Reference: K. G. Murty, Note on a Bard-type scheme for solving the complementarity problem, Opsearch 11 (1974).
"""
import math
import pathlib
import shlex
import sys

import numpy as np

from bodies import Body, evaluate, names
from lines import LinePair
from refined import solve_refined
from space import SpacePair

HERE = pathlib.Path(__file__).resolve().parent
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


# --- all bodies: K u = f and supports ---------------------------------------------------------------------------------


class Scene:
    """The discrete problem (eq. 3.1) of an options file as dense arrays; unknown dim a + k is component k at node a."""

    def __init__(self, path):
        self.options = read_scene(path)
        self.bodies, first = {}, 0
        self.title = self.options.pop("title", "")
        for name in names(self.options.pop("bodies")):
            self.bodies[name] = Body(name, self.options, first)
            first += len(self.bodies[name].points)
        self.options.pop("order", None)
        self.options.pop("model", None)
        self.thickness = float(self.options.pop("thickness", "1"))
        self.points = np.vstack([body.points for body in self.bodies.values()])
        self.body = np.concatenate([np.full(len(body.points), b) for b, body in enumerate(self.bodies.values())])
        self.dim = self.points.shape[1]
        self.K, self.f, self.held = np.zeros((self.dim * first,) * 2), np.zeros(self.dim * first), {}
        for body in self.bodies.values():
            self.add_cells(body)
            self.add_loads(body)
            self.add_supports(body)
        kind = LinePair if self.dim == 2 else SpacePair
        self.pairs = [kind(name, self) for name in names(self.options.pop("pairs", ""))]
        if self.options:
            raise ValueError(f"options that are not known here: {', '.join(self.options)}")

    def unknowns(self, nodes):
        """[node][component]"""
        return self.dim * np.asarray(nodes)[..., None] + np.arange(self.dim)

    def add_cells(self, body):
        force = body.asked("body_force", ",".join("0" * self.dim))
        for cell in body.cells:
            dofs = self.unknowns(body.first + cell).ravel()
            for at, weight in body.rule:
                phi, grad, det = body.gradients(cell, at)
                if det <= 0:
                    raise ValueError("a cell is tangled")
                part = np.einsum("aj,ijkl,bl->aibk", grad, body.hooke, grad, optimize=True).reshape(len(dofs), -1)
                self.K[np.ix_(dofs, dofs)] += self.thickness * weight * det * part
                self.f[dofs] += self.thickness * weight * det * np.outer(phi, evaluate(force, *(phi @ body.points[cell]))).ravel()
            if len(body.pressures):  # int (div u - p / k) q = 0 gives p, whose work is int p div v
                mass, divergence = body.volume(cell)
                self.K[np.ix_(dofs, dofs)] += self.thickness * body.bulk * divergence.T @ np.linalg.solve(mass, divergence)

    def add_loads(self, body):
        """int phi t and - int phi q nu over the facets of a side."""
        for kind in ("traction", "pressure"):
            for side in names(body.asked(f"bc_{kind}", "")):
                value = body.asked(f"bc_{kind}_{side}")
                for facet in body.sides[side]:
                    points = self.points[list(facet)]
                    for phi, normal in body.surface(points):
                        given = evaluate(value, *(phi @ points))
                        force = given * np.linalg.norm(normal) if kind == "traction" else -given[0] * normal
                        self.f[self.unknowns(facet)] += self.thickness * np.outer(phi, force)

    def add_supports(self, body):
        """Fills held: {unknown: value}. Sides with normal supports have to lie across an axis."""
        for side in names(body.asked("bc_displacement", "")):
            value = body.asked(f"bc_displacement_{side}")
            for node in {node for facet in body.sides[side] for node in facet}:
                given = evaluate(value, *self.points[node])
                self.held.update({self.dim * node + k: u for k, u in enumerate(given) if not math.isnan(u)})
        for side in names(body.asked("bc_normal", "")):
            nodes = [node for facet in body.sides[side] for node in facet]
            extent = np.ptp(self.points[nodes], axis=0)
            k = int(np.argmin(extent))
            if extent[k] > 1e-12 * extent.max():
                raise ValueError(f"side {side} of {body.name} is not across an axis")
            self.held.update({self.dim * node + k: 0.0 for node in nodes})

    def side(self, text):
        body, side = text.split(":")
        return self.bodies[body].sides[side]

    def owner(self, facets):
        """The body that has a side."""
        return next((body for body in self.bodies.values() if any(side is facets for side in body.sides.values())), None)


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


class Solution:
    """u [nodes][dim] and, per row of all pairs, multiplier p, gap left and status."""

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
        self.u, self.p = u.reshape(-1, scene.dim), forces / np.array([row[4] for row in self.rows])
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
        """Residuals of eq. 3.1 for ORIGIN, and how far the set is from a tie."""
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
        axes = "xyz"[:self.scene.dim]
        columns = {"body": self.scene.body, **dict(zip(axes, self.scene.points.T)), **{f"u_{axis}": u for axis, u in zip(axes, self.u.T)}}
        return {name: [value.item() for value in values[order]] for name, values in columns.items()}

    def contact(self, pair):
        """{node: (pressure, gap, status, force)} of a nonmortar side; without a multiplier the gap is nan, the status -1. Nodes beyond the end of
        the other side have no pressure."""
        found = {node: (0.0, math.nan, NONE, 0.0) for node in pair.nodes}
        for r in reversed(range(len(self.rows))):  # the first row of a tied node is the normal one
            owner, node, _, _, weight = self.rows[r]
            if owner is pair:  # with rows of removed nodes, that of a node has the sum of their gaps
                gap = self.gap[r] * weight / pair.weight[node]
                found[node] = (self.p[r], gap, int(self.status[r]), self.p[r] * pair.weight[node])
        for c, share in pair.share.items():
            found[c] = (sum(w * found[a][0] for a, w in share.items()), math.nan, NONE, 0.0)
        for facet in pair.facets if pair.linear else []:
            hats = [pair.hats.at(place)[0] for place in pair.shape.nodes]
            for node, hat in list(zip(facet, hats))[len(pair.hats.nodes):]:
                found[node] = (hat @ [found[corner][0] for corner in facet[:len(hat)]], math.nan, NONE, 0.0)
        found.update({c: (0.0, math.nan, NONE, 0.0) for c in pair.share if pair.is_beyond(c)})
        return found

    def side(self, pair):
        """Table of a nonmortar side, sorted by coordinates."""
        found = self.contact(pair)
        nodes = sorted(pair.nodes, key=lambda node: tuple(np.round(self.scene.points[node], 9)))
        rows = [(*self.scene.points[node], *found[node]) for node in nodes]
        return {name: [row[k] for row in rows] for k, name in enumerate((*"xyz"[:self.scene.dim], "p", "gap", "active", "force"))}


if __name__ == "__main__":
    from tables import main

    main(sys.argv[1:])
