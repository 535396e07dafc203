"""A shrink fit of two rings of tetrahedra whose nodes lie on their cylinders in no order, as mesh generators place them: Lame's pressure everywhere.

With normals that are means over facets, 24 of 78 nodes (order 1) and 53 of 275 (order 2) are in contact, and pressures reach 12 and 42 times Lame's.
"""
import itertools
import math

import numpy as np
from judge import near

PRESSURE = 0.128781
ANGLES, HEIGHTS, RADII = 12, 5, 3


def nodes_of(inner, outer, seed):
    """Nodes of a quarter of a ring, between planes z = 0 and 1: moved along their cylinders, those of edges along the edges."""
    random = np.random.default_rng(seed)
    points = np.empty((ANGLES + 1, HEIGHTS + 1, RADII + 1, 3))
    for i, j, k in itertools.product(range(ANGLES + 1), range(HEIGHTS + 1), range(RADII + 1)):
        a, z = (random.uniform(-0.3, 0.3) if 0 < n < most else 0 for n, most in ((i, ANGLES), (j, HEIGHTS)))
        angle, radius = math.pi / 2 * (i + a) / ANGLES, inner + (outer - inner) * k / RADII
        points[i, j, k] = radius * math.cos(angle), radius * math.sin(angle), (j + z) / HEIGHTS
    points[-1, :, :, 0] = points[0, :, :, 1] = 0
    return points.reshape(-1, 3)


def write(path, inner, outer, seed):
    """Each brick in six tetrahedra around its diagonal."""
    number = np.arange(1, (ANGLES + 1) * (HEIGHTS + 1) * (RADII + 1) + 1).reshape(ANGLES + 1, HEIGHTS + 1, RADII + 1)
    where = {node: at for at, node in np.ndenumerate(number)}
    planes = {"y0": (0, 0), "x0": (0, ANGLES), "z0": (1, 0), "z1": (1, HEIGHTS), "inside": (2, 0), "outside": (2, RADII)}
    cells, facets = [], []
    for brick in itertools.product(range(ANGLES), range(HEIGHTS), range(RADII)):
        for order in itertools.permutations(range(3)):
            at, corners = list(brick), [number[brick]]
            for axis in order:
                at[axis] += 1
                corners.append(number[tuple(at)])
            cells.append(corners)
            for omitted in range(4):
                facet = corners[:omitted] + corners[omitted + 1:]
                facets += [(group, facet) for group, (axis, value) in enumerate(planes.values(), 1) if all(where[n][axis] == value for n in facet)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "7", *(f'2 {g} "{name}"' for g, name in enumerate(planes, 1)), '3 7 "body"']
    lines += ["$EndPhysicalNames", "$Nodes", str(number.size)]
    lines += [f"{n} {x:.17g} {y:.17g} {z:.17g}" for n, (x, y, z) in enumerate(nodes_of(inner, outer, seed), 1)]
    lines += ["$EndNodes", "$Elements", str(len(facets) + len(cells))]
    rows = [(2, group, facet) for group, facet in facets] + [(4, 7, cell) for cell in cells]
    lines += [f"{n} {kind} 2 {group} {group} {' '.join(map(str, nodes))}" for n, (kind, group, nodes) in enumerate(rows, 1)]
    path.write_text("\n".join([*lines, "$EndElements", ""]), encoding="ascii")


def judge(run):
    files = run.folder / "inner.msh", run.folder / "outer.msh"
    write(files[0], 1, 2, 1)
    write(files[1], 1.999, 3, 2)
    for order in 1, 2:
        fit = run.again("-inner_dm_plex_filename", str(files[0]), "-outer_dm_plex_filename", str(files[1]), "-order", str(order), name=f"order{order}")
        pressure = np.array(fit.table("fit")["pressure"])
        near(f"order {order}: nodes in contact", fit.pair("fit")["active_nodes"], len(pressure))
        near(f"order {order}: mean pressure", fit.pair("fit")["mean_pressure"], PRESSURE, relative=0.02)
        near(f"order {order}: least and largest pressure", [pressure.min(), pressure.max()], [PRESSURE, PRESSURE], relative=0.5)
