"""Layers of one body in series, held at their ends: uniaxial strain eps_i = p / M_i in each, M = E (1-nu) / ((1+nu) (1-2 nu)). The
displacement is piecewise linear, and each order of cells has it exactly. The stress along the layers, nu / (1-nu) p, jumps between them."""
import numpy as np

from judge import near, require, same

PRESSURE = 0.1
# height, E, nu, region as the file numbers it: place among -strip_regions, 0 in none
PLANE = [(0.3, 1.0, 0.2, 1), (0.4, 1000.0, 0.3, 2), (0.3, 5.0, 0.3, 0)]
SOLID = [(0.4, 1.0, 0.2, 1), (0.6, 1000.0, 0.3, 2)]


def strain(young, poisson):
    return PRESSURE * (1 + poisson) * (1 - 2 * poisson) / (young * (1 - poisson))


def exact(layers, height):
    """Displacement at heights, of the same shape."""
    tops = np.cumsum([0] + [thickness for thickness, *_ in layers])
    ends = np.cumsum([0] + [-thickness * strain(young, poisson) for thickness, young, poisson, _ in layers])
    return np.interp(height, tops, ends)


def blocks(cells):
    """(places in the list of cells, points) of each cell."""
    from meshes import cells_by_size  # pylint: disable=import-outside-toplevel

    for places, points in cells_by_size(cells).values():
        yield from zip(places, points)


def check_fields(run, layers, dim, tolerance=1e-10):
    """Every point of the file: displacement, stress of its layer; every cell: its region."""
    with run.fields() as file:
        points, u, stress, region, cells = (file[name][()] for name in ("points", "displacement", "stress", "region", "cells"))
    high = dim - 1
    scale = abs(exact(layers, 1.0))
    require(np.abs(u[:, high] - exact(layers, points[:, high])).max() <= tolerance * scale, "displacement across the layers")
    require(np.abs(np.delete(u, high, axis=1)).max() <= tolerance * scale, "displacement along the layers")
    tops = np.cumsum([thickness for thickness, *_ in layers])
    seen = np.zeros(len(points), dtype=int)
    for place, mine in blocks(cells):
        _, _, poisson, number = layers[int(np.searchsorted(tops, points[mine, high].mean()))]
        same("region of a cell", int(region[place]), number)
        along = -poisson / (1 - poisson) * PRESSURE
        expected = np.diag([along, -PRESSURE, along] if dim == 2 else [along, along, -PRESSURE]).ravel()
        require(np.abs(stress[mine] - expected).max() <= tolerance * PRESSURE, f"stress of cell {place} in region {number}")
        seen[mine] = 1
    require(seen.all(), "points without cells")


def check_summary(run, layers):
    body = run.summary["scene"]["bodies"]["strip"]
    found = {one["name"]: (one["volume"], one["young"], one["poisson"]) for one in body["regions"]}
    names = {0: None, 1: "soft", 2: "stiff layer" if len(layers) == 3 else "2"}  # as typed
    same("regions", set(found), {names[number] for *_, number in layers})
    same("cells", sum(one["cells"] for one in body["regions"]), body["cells"])
    for thickness, young, poisson, number in layers:
        near(f"region {names[number]}", found[names[number]], [thickness, young, poisson], relative=1e-13)


def judge(run):
    solid = run.summary["scene"]["dimension"] == 3
    layers = SOLID if solid else PLANE
    check_summary(run, layers)
    check_fields(run, layers, 3 if solid else 2)
    if solid:
        return
    below, above = run.probe("low"), run.probe("high")  # beside the bond of the first two layers
    for probe, (_, _, poisson, _) in zip((below, above), layers):
        near("stress along the layers", probe["stress"][0], -poisson / (1 - poisson) * PRESSURE, relative=1e-9)
