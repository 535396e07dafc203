"""Outlines of bodies of quadrilaterals with hanging nodes are their sides alone, on straight edges and under a map."""
import numpy as np

from canvas import load
from judge import near, require


def lengths(run):
    plot = load()
    fields = plot.read_fields(str(run.folder / "result"))
    outlines, points = plot.outlines_of(fields["cells"], fields["body"], fields["points"]), fields["points"]
    every = np.concatenate([block[:, [i, (i + 1) % block.shape[1]]] for block in fields["cells"] for i in range(block.shape[1])])
    _, count = np.unique(np.sort(every, axis=1), axis=0, return_counts=True)
    require((count == 1).sum() > sum(len(edges) for edges in outlines.values()), "no node hangs")
    return [np.linalg.norm(points[edges[:, 1]] - points[edges[:, 0]], axis=1).sum() for edges in outlines.values()]


def judge(run):
    near("lengths", lengths(run), [4, 4], relative=1e-12)
    near("lengths of order 1", lengths(run.again("-order", "1", name="linear")), [4, 4], relative=1e-12)
    bent = run.again("-upper_map", "x, y + 0.2*x*(1-x)*y", "-lower_map", "x + 0.2*y*(1+y)*x, y", name="bent")
    side = np.linspace(0, 1, 100001)
    arc = np.hypot(np.diff(side), np.diff(0.2 * side * (1 - side))).sum()
    near("lengths under a map", lengths(bent), [3 + arc] * 2, relative=1e-3)
