"""A conical hole in a file of first order whose rims lie in planes that supports hold: middle nodes of order 2 and new vertices lie on the cone, also at
the rims, where they move within the plane. Gaps to a rigid cone of the same shape are zero."""
import math

from judge import require
from scenes import Findings, Scene

AROUND, HIGH, THICK = 8, 3, 2
HEIGHT, RADIUS, OUTER = 4, 6, 12


def write(path, slope):
    """A quarter of a hub of hexahedra around a hole of radius 6 + slope z."""
    groups = ["hole", "bottom", "top", "x0", "y0", "hub"]
    number = {}
    nodes, facets, cells = [], [], []
    for i in range(AROUND + 1):
        for j in range(HIGH + 1):
            for k in range(THICK + 1):
                angle, z = math.pi / 2 * i / AROUND, HEIGHT * j / HIGH
                inner = RADIUS + slope * z
                r = inner + (OUTER - inner) * k / THICK
                number[i, j, k] = len(nodes) + 1
                nodes.append((r * math.cos(angle) if i < AROUND else 0.0, r * math.sin(angle) if i else 0.0, z))
    ring = ((0, 0), (1, 0), (1, 1), (0, 1))

    def quad(i, j, k, axis):
        corners = {0: [(i, j + a, k + b) for a, b in ring], 1: [(i + a, j, k + b) for a, b in ring], 2: [(i + a, j + b, k) for a, b in ring]}[axis]
        return [number[c] for c in corners]

    for i in range(AROUND):
        for j in range(HIGH):
            for k in range(THICK):
                cells.append([number[i + a, j + b, k] for a, b in ring] + [number[i + a, j + b, k + 1] for a, b in ring])
                facets += [(1, quad(i, j, k, 2))] * (k == 0) + [(2, quad(i, j, k, 1))] * (j == 0) + [(3, quad(i, j + 1, k, 1))] * (j == HIGH - 1)
                facets += [(5, quad(i, j, k, 0))] * (i == 0) + [(4, quad(i + 1, j, k, 0))] * (i == AROUND - 1)
    rows = [f"3 2 {group} {group} {' '.join(map(str, f))}" for group, f in facets] + [f"5 2 6 6 {' '.join(map(str, c))}" for c in cells]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "6", *(f'{3 if n == 6 else 2} {n} "{name}"' for n, name in enumerate(groups, 1)),
             "$EndPhysicalNames", "$Nodes", str(len(nodes)), *(f"{n} {x!r} {y!r} {z!r}" for n, (x, y, z) in enumerate(nodes, 1)), "$EndNodes", "$Elements",
             str(len(rows)), *(f"{n} {row}" for n, row in enumerate(rows, 1)), "$EndElements", ""]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines), encoding="ascii")
    return path


def judge(run):
    found = Findings()
    for degrees in (5, 15, 40):
        slope = math.tan(math.radians(degrees))
        for refine in (0, 1):
            with found.case():
                name = f"cone_{degrees}_{refine}"
                scene = Scene(dim=3, order=2)
                scene.body("hub", young=1e5, dm_plex_filename=write(run.folder / "meshes" / f"{name}.msh", slope), bc_normal="bottom,top,x0,y0")
                scene.pairs.append("fit")
                scene.give(fit_nonmortar="hub:hole", fit_obstacle="expression",
                           fit_obstacle_gap=f"(sqrt(x^2+y^2)-{RADIUS}-{slope!r}*z)*{math.cos(math.radians(degrees))!r}")
                done = scene.solve(run, name, "-dm_refine", str(refine), "-check")
                gaps = [done.summary["check"]["pairs"]["fit"][f"{end}_gap"]["value"] for end in ("least", "largest")]
                edge = math.pi / 2 * (RADIUS + HEIGHT * slope) / AROUND
                rise = edge**2 / (8 * RADIUS)
                require(max(map(abs, gaps)) <= 1e-3 * rise, f"{name}: gaps from {gaps[0]:.3g} to {gaps[1]:.3g}, arcs rise by {rise:.3g}")
    found.end()
