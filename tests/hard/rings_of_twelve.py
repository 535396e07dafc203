"""Two rings of a file of first order, the outer one with twelve facets on its circle. These meet at 30 degrees, and are a smooth side whatever their rounding.

Where rounding decided, some facets were arcs and others were not, and forces depended on how the rings were turned. Whole rings with twelve facets each had
3.3, 5.1 and 8.7 times the force of Lame.
"""
import math

from judge import near

from lame import BORE, FIT, OVERLAP, RIM, pressure

TURNS = 0, 0.1, 0.2


def write(path, body, radii, facets, cells, turn):
    """A quarter of a ring of quadrilaterals; sides have the names of rings_file.opts."""
    inside, outside = {"inner": ("bore", "joint_i"), "outer": ("joint_o", "rim")}[body]
    names = ["cut_x", "cut_y", inside, outside]
    points, rows = [], []
    for i in range(facets + 1):
        for j in range(cells + 1):
            radius, angle = radii[0] + (radii[1] - radii[0]) * j / cells, math.pi / 2 * i / facets + turn
            points.append((radius * math.cos(angle), radius * math.sin(angle)))
    at = lambda i, j: i * (cells + 1) + j + 1
    rows += [(1, 1 + (i > 0), at(i, j), at(i, j + 1)) for i in (0, facets) for j in range(cells)]
    rows += [(1, 3 + (j > 0), at(i, j), at(i + 1, j)) for i in range(facets) for j in (0, cells)]
    rows += [(3, 5, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)) for i in range(facets) for j in range(cells)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "5", *(f'1 {n} "{name}"' for n, name in enumerate(names, 1)), f'2 5 "{body}"']
    lines += ["$EndPhysicalNames", "$Nodes", str(len(points)), *(f"{n} {x:.17g} {y:.17g} 0" for n, (x, y) in enumerate(points, 1))]
    lines += ["$EndNodes", "$Elements", str(len(rows)), *(f"{n} {kind} 2 {group} {group} {' '.join(map(str, nodes))}" for n, (kind, group, *nodes) in enumerate(rows, 1))]
    path.write_text("\n".join([*lines, "$EndElements", ""]), encoding="ascii")


def judge(run):
    forces = {}
    for turn in TURNS:
        files = run.folder / f"inner{turn}.msh", run.folder / f"outer{turn}.msh"
        write(files[0], "inner", (BORE, FIT), 4, 3, turn)
        write(files[1], "outer", (FIT, RIM), 3, 4, turn)
        for order in "1", "2":
            fit = run.again("-inner_dm_plex_filename", str(files[0]), "-outer_dm_plex_filename", str(files[1]), "-order", order, name=f"turn{turn}_{order}")
            force = fit.pair("fit")["normal_force"] / (math.pi / 2 * FIT)
            near(f"force, turned by {turn}, order {order}", force, pressure(fit.summary["options"]), relative=0.01)
            near(f"the same, not turned, order {order}", force, forces.setdefault(order, force), relative=1e-9)
