"""X5 with cells of order 2, quadrilaterals around triangles: pressures, displacements and stresses at nodes against Lame's formulas.
The picture shows curved cells."""
import importlib.machinery
import importlib.util
import math
import pathlib
import sys

import numpy as np

from judge import near, require

FIT = 0.192374956278419
U_BORE = -FIT / 3000 * 2 * 4 / 3 * (1 - 0.25 ** 2)  # plane strain: u_r = (1 - nu^2) sigma_t r / E at a free side
AREA_OUTER, AREA_INNER = math.pi / 4 * (3.5 ** 2 - 2 ** 2), math.pi / 4 * (2 ** 2 - 1)


def load_plot():
    """src/plot/mortise-plot as a module."""
    path = pathlib.Path(__file__).parents[2] / "src" / "plot" / "mortise-plot"
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader("mortise_plot", str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def exact_stress(x, y, inner):
    """xx, yy, xy, zz of two thick rings that press on each other at radius 2 with FIT."""
    a, b, pa, pb, nu = (1, 2, 0, FIT, 0.25) if inner else (2, 3.5, FIT, 0, 0.3)
    r2 = x ** 2 + y ** 2
    mean, part = (pa * a ** 2 - pb * b ** 2) / (b ** 2 - a ** 2), (pa - pb) * a ** 2 * b ** 2 / (b ** 2 - a ** 2) / r2
    c2, s2 = (x ** 2 - y ** 2) / r2, 2 * x * y / r2
    return np.column_stack([mean - part * c2, mean + part * c2, -part * s2, 2 * nu * mean + 0 * x])


def judge(run):
    near("mean pressure", run.pair("fit")["normal_force"] / run.pair("fit")["area"], FIT, relative=1e-6)
    table = run.table("fit")
    near("pressure along the joint", table["pressure"], [FIT] * len(table["pressure"]), relative=5e-4)
    near("arc length", table["arc_length"], [2 * math.atan2(x, y) for x, y in zip(table["x"], table["y"])], absolute=1e-5)
    near("bore", run.probe("bore")["displacement"][0], U_BORE, relative=5e-5)

    plot = load_plot()
    fields = plot.read_fields(str(run.folder / "result"))
    require(sorted({block.shape[1] for block in fields["cells_as_read"]}) == [6, 9], "not a mesh of tri6 and quad9")
    points, _, _, triangles, halfway = plot.smooth(fields)
    p, q, r = points[triangles].transpose(1, 2, 0)
    areas = ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2
    require(areas.min() > 0, "the picture turns triangles over")
    near("area in the picture", areas.sum(), AREA_OUTER + AREA_INNER, relative=1e-4)
    edges = plot.outlines_of(fields["cells"], fields["body"], fields["points"])[0]
    inside = [edge for edge in edges.tolist() if np.allclose(np.hypot(*points[edge].T), 2)]
    between = [plot.bend(edge, halfway)[1] for edge in inside]
    near("radius of curved edges", np.hypot(*points[between].T), [2] * len(between), relative=1e-5)

    with run.fields() as file:
        x, y, _ = file["points"][()].T
        stress = file["stress"][()][:, [0, 4, 1, 8]]
        inner = np.zeros(len(x), dtype=bool)
        cells, body = plot.split(plot.read_cells(file["cells"][()]), file["body"][()])
        for part, number in zip(cells, np.split(body, np.cumsum([len(c) for c in cells])[:-1])):
            inner[part[number == 1]] = True
    for which, name in ((inner, "inner"), (~inner, "outer")):
        exact = exact_stress(x[which], y[which], name == "inner")
        off = np.abs(stress[which] - exact).max()
        require(off <= 2e-3 * np.abs(exact).max(), f"stress of the {name} ring is off by {off:.3g} of {np.abs(exact).max():.3g}")
