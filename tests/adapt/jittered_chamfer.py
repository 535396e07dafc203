"""A shrink fit of two rings of tetrahedra in no order. The bore has a lead-in chamfer of 15 degrees, two facets wide.

The chamfer leaves the shaft, so the overlap of 0.001 is the least gap, wherever a mean over facets is not below it. Without an edge between bore and
chamfer, arcs of mean normals rose above both: overlaps were up to 45 times as large. Middle nodes on the edge are on
both surfaces: with a sum of both offsets there, overlaps were 1.9 to 4.9 times as large (order 2, or refined).
"""
import math

from jittered_rings import point, write
from judge import require

OVERLAP, ANGLE, FACETS = 0.001, math.radians(15), (6, 7, 2)
END = 2 / FACETS[1]


def place(angle, height, radius):
    """Nodes of the second row are on the edge."""
    height = END if abs(height - END) < 0.35 / FACETS[1] else height
    inside = max(0, 3 - radius) / (3 - (1 + 1 - OVERLAP))
    return point(angle, height, radius + inside * math.tan(ANGLE) * max(0, END - height))


def judge(run):
    files = run.folder / "inner.msh", run.folder / "outer.msh"
    write(files[0], 1, 2, 1, FACETS)
    write(files[1], 2 - OVERLAP, 3, 2, FACETS, place=place)
    shaft = "-fit_nonmortar", "inner:outside", "-fit_mortar", "outer:inside"
    once = "-dm_refine", "1"
    for name, order, words, most in (("bore", "1", (), 2.1), ("shaft", "1", shaft, 2.1), ("bore2", "2", (), 1.2), ("shaft2", "2", shaft, 1.2),
                                     ("refined", "1", once, 1.2), ("refined2", "2", (*shaft, *once), 1.05)):
        fit = run.again("-inner_dm_plex_filename", str(files[0]), "-outer_dm_plex_filename", str(files[1]), "-order", order, "-check", *words, name=name)
        overlap = fit.summary["check"]["pairs"]["fit"]["initial_overlap"]
        require(0.95 < overlap / OVERLAP < most, f"{name}: the overlap is {overlap / OVERLAP:.3g} times that of the fit")
