"""contact.py -- one pair for independent.py, on lines or in space: from points on both sides to the rows of B."""
import itertools
import math

import numpy as np

from bodies import MANY, SHAPES, evaluate, is_simplex, normal_of, product_rule
from refined import solve_refined

# A node with less cover (in that dimension, of facets of that order) or freedom has no multiplier.
SLIVER, NOTHING, HELD = {(2, 1): 1e-3, (2, 2): 5e-2, (3, 1): 1e-3, (3, 2): 0.1}, 1e-13, 0.1
BEYOND = 0.45  # covered part of the facets around a node
LEFT_OVER = 0.1  # of its own weight, beside the rows that a node takes over
SHARE = 0.2  # of a middle node of a quadratic triangle that its corners take over, whose shape functions integrate to zero


def unit(v):
    return v / math.hypot(*v)


def frame(n):
    """Orthonormal vectors, the first one n."""
    Q = np.linalg.qr(np.column_stack([n, np.eye(len(n))]))[0].T
    Q[0] = n
    return Q


def add_to(sums, key, value):
    sums[key] = sums.get(key, 0.0) + value


def turning(v, n, gradients):
    """{node: block} of how v turns with the mortar side's displacement (eq. 5.4); gradients: {node: of its shape function along the facet}."""
    return {b: (v @ g) * np.eye(len(v)) - (v @ n) * np.outer(g, n) for b, g in gradients.items()}


def beside(x, y, n, along, gradients):
    """{node: what joins its shape function at y} of a row at x that meets the facet through y along its own direction (4.6)."""
    to = x + (y - x) @ n / (along @ n) * along - y if along @ n < -0.3 else np.zeros(len(x))
    return {b: to @ g for b, g in gradients.items()}


class Pair:
    """Weights, couplings and gaps of eqs. 3.2 and 3.3, and from them the rows of B with one multiplier each.

    What is left open: set_normals() sums up normals at nodes; rays(facet) yields points of a facet: place on the reference
    facet, weight, gap, {mortar node: shape function}, and of ties {mortar node: what it does to the link}, of contacts a function that turns a
    row's direction into {mortar node: what joins the shape function}; read_obstacle() reads one.
    """

    def __init__(self, name, scene):
        self.name, self.scene = name, scene
        option = lambda key, default=None: scene.options.pop(f"{name}_{key}", default)
        self.facets, mortar = scene.side(option("nonmortar")), option("mortar")
        self.mortar = scene.side(mortar) if mortar else None
        self.tied = option("type", "contact") == "tied"
        self.gap, self.offset = option("gap"), option("gap_offset", "0")
        self.linear = option("multipliers", "nodes") == "vertices"
        owner, self.mortar_body = (scene.owner(side) for side in (self.facets, self.mortar))
        self.kind, self.shape = owner.facet_kind, owner.facet_shape
        self.order = 1 if self.linear else owner.order
        self.hats = SHAPES[self.kind, self.order]
        option("reach"), option("exact_pressure")  # everything here is within reach
        if not mortar:
            self.read_obstacle(option)
        self.nodes = list(dict.fromkeys(node for facet in self.facets for node in facet))
        self.set_normals()
        self.normal = {node: unit(n) for node, n in self.normal.items()}
        self.take_out_held()
        self.integrate()
        self.set_rows()

    def take_out_held(self):
        """Takes the prescribed directions out of the normals; free: what is left of them."""
        dim, self.free = self.scene.dim, {}
        for node, n in self.normal.items():
            part = np.array([0.0 if dim * node + k in self.scene.held else n[k] for k in range(dim)])
            self.free[node] = math.hypot(*part)
            if self.free[node] >= HELD:
                self.normal[node] = part / self.free[node]

    # --- integrals and rows ---

    def hat(self, at):
        """What the multipliers are dual to, at a point of the reference facet."""
        phi = self.hats.at(at)[0]
        if len(phi) != 6:
            return phi
        for corner in range(3):
            phi[corner] += SHARE * sum(phi[3 + k] for k in range(3) if self.beside_each_other(self.hats, corner, 3 + k))
        phi[3:] *= 1 - 2 * SHARE
        return phi

    def beside_each_other(self, shape, i, j):
        """Whether two nodes of a facet are neighbours on its lattice."""
        step = shape.nodes[i] - shape.nodes[j]
        steps = [*step, step.sum()] if is_simplex(self.kind) and len(step) == 2 else [np.abs(step).sum()]
        return i != j and np.abs(steps).max() < 1.5 / self.order

    def integrate(self):
        """Per multiplier: its weight D_aa, its weight were all covered, G, and {node: int psi phi, of the mortar side with a
        minus}; psi from the biorthogonality (eq. 3.4) on what is covered, to phi or, with one multiplier per vertex, to hats."""
        self.D, self.full, self.G, self.row, self.beside, self.arms = {}, {}, {}, {}, {}, {}
        self.size, self.cover = {}, {}  # of the facets around a node, of their covered parts
        for facet in self.facets:
            points = self.scene.points[list(facet)]
            for at, w in product_rule(self.kind, MANY):
                measure = np.linalg.norm(normal_of(points.T @ self.shape.at(at)[1]))
                for node in facet:
                    self.size[node] = self.size.get(node, 0.0) + w * measure
                for node, value in zip(facet, self.hat(at)):
                    self.full[node] = self.full.get(node, 0.0) + w * measure * value
            rays = list(self.rays(facet))
            if rays:
                self.add_facet(facet, points, rays)

    def gap_at(self, x, measured):
        given = measured if self.gap is None else evaluate(self.gap, *x)[0]
        return given + evaluate(self.offset, *x)[0]

    def add_facet(self, facet, points, rays):
        w = np.array([ray[1] for ray in rays])
        hat, phi = (np.column_stack([shape(ray[0]) for ray in rays]) for shape in (self.hat, lambda at: self.shape.at(at)[0]))
        exact = hat.astype(np.longdouble)  # of a sliver: its matrix is nearly singular
        psi = np.diag(hat @ w) @ solve_refined((exact * w) @ exact.T, hat)
        for node in facet:
            self.cover[node] = self.cover.get(node, 0.0) + w.sum()
        gaps = [self.gap_at(x, ray[2]) for x, ray in zip(phi.T @ points, rays)]
        for i, j in itertools.permutations(range(len(hat)), 2):
            if self.beside_each_other(self.hats, i, j):
                self.beside.setdefault(facet[i], set()).add(facet[j])
        for i, node in enumerate(facet[:len(hat)]):
            self.D[node] = self.D.get(node, 0.0) + w @ hat[i]
            row = self.row.setdefault(node, {})
            for b, value in zip(facet, (psi[i] * w) @ phi.T):
                row[b] = row.get(b, 0.0) + value
            self.G[node] = self.G.get(node, 0.0) + (w * psi[i]) @ gaps
            for (_, _, _, mortar, more), weight in zip(rays, w * psi[i]):
                for b, shape in mortar.items():
                    row[b] = row.get(b, 0.0) - weight * shape
                for b, value in more.items() if self.tied else more(self.normal[node]).items():
                    add_to(self.arms.setdefault(node, {}) if self.tied else row, b, -weight * value)

    def keeps(self, node):
        """Whether a node carries its multiplier."""
        return self.D[node] >= SLIVER[self.scene.dim, self.order] * self.full[node] and self.free[node] >= HELD

    def held(self, node):
        """1 for each axis along which a support holds a node, 0 for others."""
        return np.array([float(self.scene.dim * node + k in self.scene.held) for k in range(self.scene.dim)])

    def is_beyond(self, node):
        """Whether a node without a multiplier lies beyond the end of the other side; at that end half of its facets are covered."""
        return self.cover[node] < BEYOND * self.size[node]

    def shares(self, kept, removed):
        """{removed node: {kept node: weight}}: the mean over neighbours along the side, in rings around the kept nodes."""
        known, waiting = {a: {a: 1.0} for a in kept}, set(removed)
        while ring := {c: [b for b in self.beside[c] if b in known] for c in waiting if self.beside[c] & known.keys()}:
            known.update({c: {a: sum(known[b].get(a, 0.0) for b in near) / len(near) for b in near for a in known[b]}
                          for c, near in ring.items()})
            waiting -= ring.keys()
        return {c: known.get(c, {}) for c in removed}

    def set_rows(self):
        """Rows of B as {unknown: value} over D_aa; those of removed nodes are shared out among kept ones (eq. 5.1)."""
        touched = [node for node in self.D if abs(self.D[node]) > NOTHING * self.full[node]]
        kept, overdrawn, self.rows = [node for node in touched if self.keeps(node)], True, []
        while overdrawn:
            self.share = self.shares(kept, [node for node in touched if node not in kept])
            taken = {a: sum(share.get(a, 0.0) * self.D[c] for c, share in self.share.items()) for a in kept}
            overdrawn = [a for a in kept if self.D[a] + taken[a] < LEFT_OVER * self.D[a]]
            kept = [a for a in kept if a not in overdrawn]
        row, G = {node: dict(self.row[node]) for node in kept}, {node: self.G[node] for node in kept}
        arms = {node: dict(self.arms.get(node, {})) for node in kept}
        for c, a, w in [(c, a, w) for c, share in self.share.items() for a, w in share.items()]:
            G[a] += w * self.G[c]
            for b, value in self.row[c].items():
                row[a][b] = row[a].get(b, 0.0) + w * value
            for b, block in self.arms.get(c, {}).items():
                add_to(arms[a], b, w * block)
        weight = {a: sum(row[a].get(b, 0.0) for b in self.nodes) for a in kept}
        self.weight = {a: self.scene.thickness * weight[a] for a in kept}
        if self.tied:
            self.pass_held(kept, row, arms, weight)
        for a in kept:
            dim, D = self.scene.dim, self.D[a]
            for direction in self.directions(a):
                entries = {dim * b + k: value / D * direction[k] for b, value in row[a].items() for k in range(dim)}
                for b, k in itertools.product(arms[a], range(dim)):
                    add_to(entries, dim * b + k, direction @ arms[a][b][:, k] / D)
                self.rows.append((a, entries, 0.0 if self.tied else G[a] / D, self.scene.thickness * D))

    def directions(self, node):
        """The normal; of ties also those across it, without those along which a support holds the node."""
        held = np.eye(self.scene.dim)[self.held(node) > 0]
        across = np.linalg.svd(np.vstack([self.normal[node], held]))[2][1 + len(held):]
        return (self.normal[node], *across) if self.tied else (self.normal[node],)

    def pass_held(self, kept, row, arms, weight):
        """Rows along held axes go to nodes that nothing holds (eq. 5.5), in blocks."""
        given = {node: (dict(row[node]), dict(arms[node])) for node in kept if self.held(node).any()}
        for c, share in self.shares([a for a in kept if a not in given], given).items():
            P = np.diag(self.held(c))
            for a, w in share.items():
                for b, value in given[c][0].items():
                    add_to(arms[a], b, w * value * P)
                for b, block in given[c][1].items():
                    add_to(arms[a], b, w * P @ block)
                self.weight[a] += self.scene.thickness * w * weight[c] * (self.normal[a] @ P @ self.normal[a])
