"""A shrink fit of two rings of tetrahedra in no order. The bore has a lead-in chamfer of 15 degrees, two facets wide.

The chamfer leaves the shaft, so the overlap of 0.001 is the least gap, wherever a mean over facets is not below it. Without an edge between bore and
chamfer, arcs of mean normals rose above both: overlaps were up to 45 times as large.
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
    for name, order, words in (("bore", "1", ()), ("shaft", "1", ("-fit_nonmortar", "inner:outside", "-fit_mortar", "outer:inside")), ("bore2", "2", ())):
        fit = run.again("-inner_dm_plex_filename", str(files[0]), "-outer_dm_plex_filename", str(files[1]), "-order", order, "-check", *words, name=name)
        overlap = fit.summary["check"]["pairs"]["fit"]["initial_overlap"]
        require(OVERLAP <= 1.05 * overlap <= 2.2 * OVERLAP, f"{name}: the overlap is {overlap / OVERLAP:.3g} times that of the fit")
