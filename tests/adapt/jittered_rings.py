"""A shrink fit of two rings of tetrahedra whose nodes lie on their cylinders in no order, as mesh generators place them: Lame's pressure everywhere.

With normals that are means over facets, 24 of 78 nodes (order 1) and 53 of 275 (order 2) are in contact, and pressures reach 12 and 42 times Lame's.
Refined along the parabolas of a file of second order, larger cells have 4.7 times Lame's pressure, then 10 times, and 1.14 and 1.16 times in the mean.
"""
import itertools
import math

import numpy as np
from judge import near

PRESSURE = 0.128781
CELLS = 12, 5, 3  # along angle, height and radius


def nodes_of(inner, outer, seed, most):
    """Nodes of a quarter of a ring, between planes z = 0 and 1, as (angle, height, radius): moved along their cylinders, those of edges along the
    edges."""
    random = np.random.default_rng(seed)
    nodes = np.empty((*(n + 1 for n in most), 3))
    for i, j, k in itertools.product(*(range(n + 1) for n in most)):
        a, z = (random.uniform(-0.3, 0.3) if 0 < n < last else 0 for n, last in ((i, most[0]), (j, most[1])))
        nodes[i, j, k] = math.pi / 2 * (i + a) / most[0], (j + z) / most[1], inner + (outer - inner) * k / most[2]
    return nodes.reshape(-1, 3)


def point(angle, height, radius):
    """On cylinders."""
    return [0 if abs(x) < 1e-12 else radius * x for x in (math.cos(angle), math.sin(angle))] + [height]


class Middles:
    """Middle nodes of edges, on the surface where both ends are on one."""

    def __init__(self, nodes, place):
        self.nodes, self.place, self.numbers = nodes, place, {}
        self.points = [place(*node) for node in nodes]

    def add(self, *ends):
        if frozenset(ends) not in self.numbers:
            a, b = (self.nodes[end - 1] for end in ends)
            straight = np.mean([self.place(*a), self.place(*b)], axis=0)
            self.points.append(straight if abs(a[2] - b[2]) > 1e-12 else self.place(*(a + b) / 2))
            self.numbers[frozenset(ends)] = len(self.points)
        return self.numbers[frozenset(ends)]


def write(path, inner, outer, seed, most=CELLS, order=1, place=point):
    """Each brick in six tetrahedra around its diagonal. [in] place - of a node, from its angle, height and radius"""
    number = np.arange(1, math.prod(n + 1 for n in most) + 1).reshape([n + 1 for n in most])
    where = {node: at for at, node in np.ndenumerate(number)}
    planes = {"y0": (0, 0), "x0": (0, most[0]), "z0": (1, 0), "z1": (1, most[1]), "inside": (2, 0), "outside": (2, most[2])}
    middles = Middles(nodes_of(inner, outer, seed, most), place)
    edges = {3: [(0, 1), (1, 2), (2, 0)], 4: [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]}
    cells, facets = [], []
    for brick in itertools.product(*map(range, most)):
        for axes in itertools.permutations(range(3)):
            at, corners = list(brick), [number[brick]]
            for axis in axes:
                at[axis] += 1
                corners.append(number[tuple(at)])
            cells.append(corners)
            for omitted in range(4):
                facet = corners[:omitted] + corners[omitted + 1:]
                facets += [(group, facet) for group, (axis, value) in enumerate(planes.values(), 1) if all(where[n][axis] == value for n in facet)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "7", *(f'2 {g} "{name}"' for g, name in enumerate(planes, 1)), '3 7 "body"']
    rows = [(2, group, facet) for group, facet in facets] + [(4, 7, cell) for cell in cells]
    if order == 2:
        rows = [({2: 9, 4: 11}[kind], group, nodes + [middles.add(nodes[i], nodes[j]) for i, j in edges[len(nodes)]]) for kind, group, nodes in rows]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(middles.points))]
    lines += [f"{n} {x:.17g} {y:.17g} {z:.17g}" for n, (x, y, z) in enumerate(middles.points, 1)]
    lines += ["$EndNodes", "$Elements", str(len(rows))]
    lines += [f"{n} {kind} 2 {group} {group} {' '.join(map(str, nodes))}" for n, (kind, group, nodes) in enumerate(rows, 1)]
    path.write_text("\n".join([*lines, "$EndElements", ""]), encoding="ascii")


def judge(run):
    for name, order, most, words, within in (("order1", 1, CELLS, ("-order", "1"), 0.5), ("order2", 1, CELLS, ("-order", "2"), 0.5),
                                             ("parabolas", 2, (6, 4, 2), ("-order", "2", "-dm_refine", "1"), 1),
                                             ("linear", 2, (6, 4, 2), ("-order", "1", "-dm_refine", "2"), 0.6)):
        files = run.folder / f"{name}_inner.msh", run.folder / f"{name}_outer.msh"
        write(files[0], 1, 2, 1, most, order)
        write(files[1], 1.999, 3, 2, most, order)
        fit = run.again("-inner_dm_plex_filename", str(files[0]), "-outer_dm_plex_filename", str(files[1]), *words, name=name)
        pressure = np.array(fit.table("fit")["pressure"])
        near(f"{name}: nodes in contact", fit.pair("fit")["active_nodes"], len(pressure))
        near(f"{name}: mean pressure", fit.pair("fit")["mean_pressure"], PRESSURE, relative=0.02)
        near(f"{name}: least and largest pressure", [pressure.min(), pressure.max()], [PRESSURE, PRESSURE], relative=within)
        if name == "order1":
            mapped = fit.again("-inner_map", "x,y,z", "-outer_map", "x,y,z", name="mapped")
            near("pressure of mapped files", mapped.table("fit")["pressure"], pressure, absolute=1e-9 * PRESSURE)
