"""A shrink fit of a tubular ring in another one, of tetrahedra whose nodes lie on their tori in no order: an eighth of the turn, above a plane of symmetry.

The pressure is that of the axisymmetric model with maps. With normals that are means over facets, 137 of 357 nodes are in contact, and pressures are 1.26
times as large in the mean, 13 times at most.
"""
import math

import numpy as np
from jittered_rings import write
from judge import Run, near, require

RING, OVERLAP, CELLS = 3, 1e-3, (20, 16, 2)


def place(angle, height, radius):
    """Angles around the tube and around the axis."""
    x, z = RING + radius * math.cos(2 * angle), radius * math.sin(2 * angle)
    turn = math.pi / 4 * height
    return [0 if abs(value) < 1e-12 else value for value in (x * math.cos(turn), x * math.sin(turn), z)]


def section(body, inner, outer):
    """Options of a body in the section of the axisymmetric model."""
    words = {"dm_plex_simplex": "0", "dm_plex_box_lower": f"{inner},0", "dm_plex_box_upper": f"{outer},pi", "dm_plex_box_faces": "6,40"}
    words |= {"map": f"{RING}+x*cos(y), x*sin(y)", "bc_normal": "bottom,top", "young": "1000", "poisson": "0.3"}
    return [word for option, value in words.items() for word in (f"-{body}_{option}", value)]


def judge(run):
    pair = "-pairs", "fit", "-fit_nonmortar", "inner:right", "-fit_mortar", "outer:left"
    words = "-bodies", "inner,outer", "-model", "axisymmetric", "-order", "2", *section("inner", 0.4, 1), *section("outer", 1 - OVERLAP, 1.6), *pair
    exact = Run(run.program, run.mpiexec, 1, run.folder / "exact", words)
    exact.require_solved()
    known = exact.table("fit")
    angles = np.arctan2(known["y"], np.array(known["x"]) - RING)
    files = run.folder / "inner.msh", run.folder / "outer.msh"
    write(files[0], 0.4, 1, 1, CELLS, place=place)
    write(files[1], 1 - OVERLAP, 1.6, 2, CELLS, place=place)
    fit = run.again("-inner_dm_plex_filename", str(files[0]), "-outer_dm_plex_filename", str(files[1]), "-order", "1", name="solid")
    table = fit.table("fit")
    x, y, z, pressure = (np.array(table[column]) for column in ("x", "y", "z", "pressure"))
    order = np.argsort(angles)
    share = pressure / np.interp(np.arctan2(z, np.hypot(x, y) - RING), angles[order], np.array(known["pressure"])[order])
    require(fit.pair("fit")["active_nodes"] > 0.96 * len(pressure), f"{fit.pair('fit')['active_nodes']} of {len(pressure)} nodes are in contact")
    near("pressure, share of that of the section", share.mean(), 1, absolute=0.07)
    require(np.sqrt(np.mean((share - 1) ** 2)) < 0.6, f"pressures are off by {np.sqrt(np.mean((share - 1) ** 2)):.2g} times those of the section")
