"""The order of facets in a file is no matter. The direction of contact of a convex edge above a groove depends on whether both flanks are near it, in parts of
a facet. Of the first facet at the edge, the force was (-6.9, 30.5) or (11.3, 26.9)."""
import math

from judge import near, same

OFFSET, DEPTH, SLOPE = 0.06, 0.05, math.tan(math.radians(24))  # of the groove

WEDGE = {
    "points": [(-1, 0.5), (0, 0), (0.1, 0.05), (1, 0.5), (-1, 1.5), (0, 1.5), (1, 1.5)],
    "cells": [(0, 1, 5), (0, 5, 4), (1, 2, 5), (2, 3, 5), (3, 6, 5)],
    "sides": {"tip": [(0, 1), (1, 2), (2, 3)], "top": [(4, 5), (5, 6)]},
}
GROOVE = {
    "points": [(OFFSET + x, SLOPE * abs(x) - DEPTH if y else -3) for y in (1, 0) for x in (-2, 0, 2)],
    "cells": [(0, 3, 1), (3, 4, 1), (1, 4, 5), (1, 5, 2)],
    "sides": {"groove": [(0, 1), (1, 2)], "bottom": [(3, 4), (4, 5)]},
}


def write(path, points, cells, sides, turned):
    """A Gmsh file; turned: with cells and facets in the opposite order."""
    order = -1 if turned else 1
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3", '2 3 "all"', *(f'1 {n} "{side}"' for n, side in enumerate(sides, 1)), "$EndPhysicalNames"]
    lines += ["$Nodes", str(len(points)), *(f"{n} {x!r} {y!r} 0" for n, (x, y) in enumerate(points, 1)), "$EndNodes"]
    elements = [(1, n, facet) for n, side in enumerate(sides, 1) for facet in sides[side][::order]] + [(2, 3, cell) for cell in cells[::order]]
    lines += ["$Elements", str(len(elements))]
    lines += [f"{k} {kind} 2 {tag} {tag} {' '.join(str(node + 1) for node in nodes)}" for k, (kind, tag, nodes) in enumerate(elements, 1)]
    path.write_text("\n".join(lines + ["$EndElements"]) + "\n")


def judge(run):
    results = []
    for turned in (False, True):
        files = [run.folder / f"{name}_{turned}.msh" for name in ("wedge", "groove")]
        for path, mesh in zip(files, (WEDGE, GROOVE)):
            write(path, **mesh, turned=turned)
        results.append(run.again("-wedge_dm_plex_filename", str(files[0]), "-groove_dm_plex_filename", str(files[1]), name=f"turned_{turned}"))
    first, second = (result.pair("joint") for result in results)
    same("nodes in contact", second["active_nodes"], first["active_nodes"])
    near("force", second["force"], first["force"], relative=1e-9)
    near("largest pressure", second["max_pressure"], first["max_pressure"], relative=1e-9)
