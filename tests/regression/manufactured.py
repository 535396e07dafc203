"""M1, M2: observed orders of convergence, sizes of the errors of order 2, and what the norms are.

In M2 the loads have a kink at x = 0.55. Where a column of cells lies across it, the error in L2 depends on their quadrature and its
order is erratic. Orders are therefore taken on meshes with a line there.
"""
import math
import pathlib

import norms
from judge import near, require

LADDER = {("full", 1): ((32, 48), (64, 96)), ("full", 2): ((16, 24), (32, 48)),  # facets above and below, two meshes
          ("partial", 1): ((40, 60), (80, 120)), ("partial", 2): ((20, 40), (40, 80))}
LADDER_QUADS = LADDER | {("partial", 1): ((20, 30), (40, 60))}  # triangles get to their orders later
ORDERS = {"energy": {1: (1.0, 0.02), 2: (2.0, 0.03)}, "l2": {1: (2.0, 0.05), 2: (3.0, 0.1)}}  # expected, and how near
PRESSURE = {("full", 1): 0.95, ("full", 2): 1.9, ("partial", 1): 0.95, ("partial", 2): 1.9}  # at least
# Energy and L2 norm at n = 32 of an independent program of order 2, whose multipliers are continuous and belong to vertices. Errors of
# the pressure are another matter: here 1.2 (quads) to 2.3 (triangles) times its own. For M2, L2 is not compared: see above.
LISTED = {("full", "triangles"): (1.7017e-4, 8.0377e-7), ("full", "quads"): (1.1851e-4, 5.9090e-7),
          ("partial", "triangles"): (2.4024e-4, math.inf), ("partial", "quads"): (1.5406e-4, math.inf)}
ALLOWED = 1.05
MATERIALS = {"upper": (1.0, 0.3), "lower": (3.0, 0.25)}


def option(run, name, default=None):
    return run.arguments[run.arguments.index(name) + 1] if name in run.arguments else default


def exact_displacement(run, body):
    """The expressions of -<body>_exact_displacement in the options file."""
    for line in pathlib.Path(option(run, "-options_file")).read_text().splitlines():
        if line.startswith(f"-{body}_exact_displacement "):
            return line.split(" ", 1)[1].strip('"')
    raise ValueError(body)


def errors(run):
    return {**run.summary["errors_total"], "pressure": run.summary["errors"]["joint"]["pressure_l2"]}


def on_mesh(run, above, below):
    faces = ["-upper_dm_plex_box_faces", f"{above},{above}", "-lower_dm_plex_box_faces", f"{below},{below}"]
    return errors(run.again(*faces, name=f"mesh{above}"))


def judge(run):
    kind = pathlib.Path(option(run, "-options_file")).stem.removeprefix("manufactured_")
    cells = "triangles" if option(run, "-upper_dm_plex_simplex", "0") == "1" else "quads"
    order = int(option(run, "-order", "1"))
    coarse, fine = (on_mesh(run, *mesh) for mesh in (LADDER_QUADS if cells == "quads" else LADDER)[kind, order])
    seen = {name: math.log2(coarse[name] / fine[name]) for name in (*ORDERS, "pressure")}
    for name, expected in ORDERS.items():
        near(f"order of the {name} error", seen[name], expected[order][0], absolute=expected[order][1])
    require(seen["pressure"] >= PRESSURE[kind, order], f"order of the pressure error is {seen['pressure']:.3f}")
    if order == 2:
        found = fine if kind == "full" else on_mesh(run, 32, 48)
        for name, listed in zip(ORDERS, LISTED[kind, cells]):
            require(found[name] <= ALLOWED * listed, f"{name} error at n = 32 is {found[name]:.4e}, that of another program {listed:.4e}")
    same_by_other_means(run, kind)


def same_by_other_means(run, kind):
    """The scene as it stands: the other solver makes the same errors, and the norms are what Python makes of the file."""
    here, other = errors(run), errors(run.again("-snes_type", "vinewtonrsls", name="vinewtonrsls"))
    for name, value in here.items():
        near(f"{name} error by vinewtonrsls", other[name], value, relative=1e-6)
    if kind == "full":  # exact solutions without cases, which Python can read
        told = run.summary["errors"]
        for body, (name, material) in enumerate(MATERIALS.items()):
            l2, energy, size = norms.error_norms(run, body, exact_displacement(run, name), *material)
            near(f"l2 error of {name}", told[name]["l2"], l2, relative=1e-7)
            near(f"energy error of {name}", told[name]["energy"], energy, relative=1e-7)
            near(f"relative energy error of {name}", told[name]["energy_relative"], energy / size, relative=1e-7)
