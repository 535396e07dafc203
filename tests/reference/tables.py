"""tables.py -- what independent.py writes: tables, their origin, and one HDF5 file laid out as the program's own."""
import csv
import math

import numpy as np

import independent
from bodies import CORNERS, SHAPES, Shape

FIELDS = ("plates_mixed", "plates_mixed_21", "plates_vertices_2", "rings_2", "rubber", "rubber_2", "rubber_triangles_2")  # the cases that also have an HDF5 file
METHOD = """Made by tests/reference/independent.py, not by mortise: dense arrays in Python with numpy, own elements, own integration of
the contact side, contact set by Murty's least index method on the dual problem, one solution of the saddle point system.
Scene: scene.opts beside this file. Command: python3 tests/reference/independent.py {case}

"""


def von_mises(s):
    """Of tensors [n][3][3]."""
    deviator = s - np.trace(s, axis1=1, axis2=2)[:, None, None] * np.eye(3) / 3
    return np.sqrt(1.5 * np.einsum("nij,nij->n", deviator, deviator))


def sampling(kind, order):
    """Where stresses are taken in a cell, and their continuation to its nodes [node][point] (eq. 8.2)."""
    shape = SHAPES[kind, order]
    if order == 1:
        return [(1 / 3, 1 / 3) if kind == "triangle" else (0.5, 0.5)], np.ones((len(shape.nodes), 1))
    corners = np.array(CORNERS[kind], dtype=float)
    places = 0.5 + (corners - 0.5) / math.sqrt(3) if kind == "quad" else 1 / 6 + 0.5 * corners
    linear = Shape(places, SHAPES[kind, 1].powers)
    return places, np.array([linear.at(node)[0] for node in shape.nodes])


def slope_of(places):
    """Rows [n][dim] that make of values at n places the slope of the linear function nearest to them."""
    return np.linalg.pinv(places - places.mean(axis=0)).T


def is_curved(body, places):
    """Whether nodes of order 2 are off where the corners put them."""
    shape = SHAPES[body.kind, body.order]
    straight = np.array([SHAPES[body.kind, 1].at(node)[0] for node in shape.nodes]) @ places[:len(CORNERS[body.kind])]
    return np.abs(places - straight).max() > 1e-9 * np.ptp(places, axis=0).max()


def lost_stress(scene, body, sizes, stress):
    """What linear functions of curved cells of order 2 lose at their nodes: cell -> tensors [node][3][3] (eq. 8.2a)."""
    corners, where = len(CORNERS[body.kind]), [scene.points[body.first + cell] for cell in body.cells]
    slopes, area = np.zeros((len(scene.points), 2, 3, 3)), np.zeros(len(scene.points))
    for cell, size, places in zip(body.cells, sizes, where):
        vertices = body.first + cell[:corners]
        slopes[vertices] += size * np.einsum("nk,nij->kij", slope_of(places[:corners]), stress[vertices])
        area[vertices] += size
    slopes[area > 0] /= area[area > 0][:, None, None, None]
    points, continuation = sampling(body.kind, body.order)
    lost = {}
    for c, (cell, places) in enumerate(zip(body.cells, where)):
        if not is_curved(body, places):
            continue
        first = slopes[body.first + cell[:corners]]
        second = np.einsum("nk,nlij->klij", slope_of(places[:corners]), first)

        def quadratic(x, middle=places[:corners].mean(axis=0), first=first.mean(axis=0), second=second):
            off = x - middle
            return np.einsum("nl,lij->nij", off, first) + np.einsum("nk,nl,klij->nij", off, off, second) / 2

        inner = np.array([SHAPES[body.kind, body.order].at(point)[0] for point in points]) @ places
        lost[c] = quadratic(places) - np.einsum("np,pij->nij", continuation, quadratic(inner))
    return lost


def nodal_stress(scene, solution):
    """Tensors [nodes][3][3]: of the cells around a node, averaged with their areas (eqs. 8.2, 8.2a)."""
    stress, area, sizes = np.zeros((len(scene.points), 3, 3)), np.zeros(len(scene.points)), {}
    for name, body in scene.bodies.items():
        places, continuation = sampling(body.kind, body.order)
        sizes[name] = [sum(weight * body.gradients(cell, at)[2] for at, weight in body.rule) for cell in body.cells]
        for cell, size in zip(body.cells, sizes[name]):
            nodes = body.first + cell
            s = np.zeros((len(places), 3, 3))
            pressures = []
            if len(body.pressures):
                mass, divergence = body.volume(cell)
                pressures = body.bulk * np.linalg.solve(mass, divergence @ solution.u[nodes].ravel())
            for p, at in enumerate(places):
                s[p, :2, :2] = np.einsum("ijkl,nk,nl->ij", body.hooke, solution.u[nodes], body.gradients(cell, at)[1])
                s[p, 2, 2] = body.zz * np.trace(s[p])
                if len(body.pressures):
                    s[p] += pressures @ body.functions(cell, body.gradients(cell, at)[0]) * np.eye(3)
            stress[nodes] += size * np.einsum("np,pij->nij", continuation, s)
            area[nodes] += size
    stress /= area[:, None, None]
    means = stress.copy()
    for name, body in scene.bodies.items():
        for c, lost in (lost_stress(scene, body, sizes[name], means) if body.order == 2 else {}).items():
            nodes = body.first + body.cells[c]
            stress[nodes] += sizes[name][c] * lost / area[nodes][:, None, None]
    return stress


def write_fields(path, scene, solution):
    """Points, cells and nodal fields under the names and in the shapes of the program."""
    import h5py  # pylint: disable=import-outside-toplevel

    stress, count = nodal_stress(scene, solution), len(scene.points)
    pressure, gap, status = np.zeros(count), np.full(count, np.nan), np.full(count, independent.NONE)
    for pair in scene.pairs:
        for node, (p, g, state, _) in solution.contact(pair).items():
            pressure[node], gap[node], status[node] = p, g, state
    cells, owner = [], []
    for size, kind in ((3, 4), (4, 5), (6, 36), (9, 35)):  # XDMF's numbers of triangles and quads of order 1 and 2
        for b, body in enumerate(scene.bodies.values()):
            for cell in body.cells:
                if len(cell) == size:
                    cells += [kind, *(body.first + cell)]
                    owner.append(b)
    flat = lambda values: np.column_stack([values, np.zeros(count)])
    with h5py.File(path, "w", track_order=False) as file:
        file.attrs["title"], file.attrs["creator"] = scene.title, "tests/reference/independent.py"
        file["points"], file["cells"] = flat(scene.points), np.array(cells, dtype="i4")
        file["displacement"], file["stress"] = flat(solution.u), stress.reshape(count, 9)
        file["von_mises"], file["pressure"], file["gap"] = von_mises(stress), pressure, gap
        file["status"], file["body"] = status.astype("i4"), np.array(owner, dtype="i4")


def write_table(path, table):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(table)
        writer.writerows(zip(*table.values()))


def check_table(path, table, size):
    """Every number of the file again, to CHECKED of the largest of its column; columns that vanish, to that of displacements.
    [in] size - largest displacement"""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    for name, *texts in zip(*rows):
        old, new = np.array(texts, dtype=float), np.array(table[name], dtype=float)
        if not np.allclose(new, old, rtol=0, atol=independent.CHECKED * max(np.nan_to_num(np.abs(old)).max(), size), equal_nan=True):
            raise SystemExit(f"{path}: column {name} is off by {np.nanmax(np.abs(new - old)):.3g}")


def main(arguments):
    check = "--check" in arguments
    cases = [word for word in arguments if word != "--check"] or sorted(path.parent.name for path in independent.HERE.glob("*/scene.opts"))
    for case in cases:
        folder = independent.HERE / case
        scene = independent.Scene(folder / "scene.opts")
        solution = independent.Solution(scene)
        tables = {"nodes": solution.nodes(), **{pair.name: solution.side(pair) for pair in scene.pairs}}
        for name, table in tables.items():
            if check:
                check_table(folder / f"{name}.csv", table, np.abs(solution.u).max())
            else:
                write_table(folder / f"{name}.csv", table)
        report = "".join(f"{name}: {value:.2g}\n" for name, value in solution.report.items())
        if not check:
            (folder / "ORIGIN").write_text(METHOD.format(case=case) + report)
        if case in FIELDS and not check:
            write_fields(folder / "fields.h5", scene, solution)
        print(f"{case}: {2 * len(scene.points)} unknowns, {len(solution.rows)} rows, "
              f"{np.count_nonzero(solution.status > 0)} active\n{report}")
