"""A slab overlaps a flat bar, whose end has a fillet of two facets. These meet at 45 degrees, and so do those of chamfers: an edge, whatever the rounding.

The edge was smooth at some nodes and not at others. Normals of the flat side's end were tilted by a quarter, and middle nodes rose above it by a tenth
of the fillet's radius: a leaf spring on such a leaf had 17 % too much force.
"""
import math

from jittered_rings import write
from judge import require

OVERLAP, FACETS = 0.001, (6, 8, 2)
FLAT = 1 - 2 / FACETS[1]


def bar(angle, height, radius):
    """The side at radius 2 is y = 0, then a quarter of a circle of radius 1, with nodes almost in its middle."""
    row = height * FACETS[1]
    if abs(row - FACETS[1] + 2) < 0.4:
        row = FACETS[1] - 2
    turn = math.pi / 4 * max(0, round(row) - FACETS[1] + 2 + 0.02 * (row - round(row)))
    top = [3 * min(1, row / FACETS[1] / FLAT) + math.sin(turn), math.cos(turn) - 1]
    depth = 2 - radius
    return [(1 - 0.2 * depth) * top[0], (1 - depth) * top[1] - 2 * depth, angle]


def slab(angle, height, radius):
    return [5 * height, radius - 2 - OVERLAP, angle]


def judge(run):
    files = run.folder / "inner.msh", run.folder / "outer.msh"
    write(files[0], 1, 2, 1, FACETS, place=bar)
    write(files[1], 2, 3, 2, FACETS, place=slab)
    slab_carries = "-fit_nonmortar", "outer:inside", "-fit_mortar", "inner:outside"
    for name, words in (("bar", ()), ("slab", slab_carries)):
        for order in "1", "2":
            fit = run.again("-inner_dm_plex_filename", str(files[0]), "-outer_dm_plex_filename", str(files[1]), "-order", order, "-check", *words, name=name + order)
            overlap = fit.summary["check"]["pairs"]["fit"]["initial_overlap"]
            require(0.99 < overlap / OVERLAP < 1.01, f"{name}, order {order}: the overlap is {overlap / OVERLAP:.3g} times the one that is drawn")
