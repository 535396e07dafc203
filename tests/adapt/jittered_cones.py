"""A shrink fit of two conical rings of tetrahedra in no order. New nodes lie on the cone, uniformly refined and bisected, of files of both orders.

Arcs of the normals at two nodes are not on cones: nodes are up to 0.16 of an arc's rise off them. On the parabolas of a file of second order they are 0.027
off, and pressures are up to 20 times their mean.
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
            if order == 2:
                pressure = np.array(fit.table("fit")["pressure"])
                require(pressure.max() < 3 * pressure.mean(), f"{name}: the largest pressure is {pressure.max() / pressure.mean():.2g} times the mean")
            require(off < 1e-3 * RISE, f"{name}, file of order {order}: nodes are {off / RISE:.2g} of the rise off the cone")
