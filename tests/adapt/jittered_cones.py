"""A shrink fit of two conical rings of tetrahedra in no order. New nodes lie on the cone, uniformly refined and bisected, of files of both orders.

Arcs of the normals at two nodes are not on cones: nodes are up to 0.16 of an arc's rise off them. Edges of a file of second order whose middle nodes are not
on arcs stay parabolas: 0.026.
"""
import math

import numpy as np
from jittered_rings import point, write
from judge import require

SLOPE, FACETS = 0.3, (6, 4, 2)
RISE = 2 * (1 - math.cos(math.pi / 4 / FACETS[0]))


def place(angle, height, radius):
    return point(angle, height, radius + SLOPE * height)


def judge(run):
    for order in 1, 2:
        files = run.folder / f"inner{order}.msh", run.folder / f"outer{order}.msh"
        write(files[0], 1, 2, 1, FACETS, order, place)
        write(files[1], 1.999, 3, 2, FACETS, order, place)
        for name, words in (("refined", ("-dm_refine", "1")), ("bisected", ("-adapt", "0.15"))):
            fit = run.again("-inner_dm_plex_filename", str(files[0]), "-outer_dm_plex_filename", str(files[1]), "-order", "2", *words, name=f"{name}{order}")
            x, y, z = (np.array(fit.table("fit")[axis]) for axis in "xyz")
            off = np.abs(np.hypot(x, y) - 1.999 - SLOPE * z).max() / math.hypot(1, SLOPE)
            require(off < (1e-3, 0.03)[order - 1] * RISE, f"{name}, file of order {order}: nodes are {off / RISE:.2g} of the rise off the cone")
