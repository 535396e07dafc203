#!/usr/bin/env python3
"""effectivity.py <mortise> [--largest n] [--each] [name ...] -- calibrated estimate over true error in the energy norm, on adaptive meshes.

Rows are scenes by order, cells (cut into simplices, or kept), ratio of stiffness and nonmortar side. Names choose rows: all words of a name must occur
in that of the row. Meshes of more than 1000 unknowns count. Of scenes with an exact displacement, the error is that of the program's integral. Of
others it comes from the limit of the potential, on meshes of order 2 with four times the unknowns. Meshes count while the square of their error is
twenty times what is not known of this limit. Then the first mesh does not count, whose estimate has no calibration. --each prints every mesh."""
import argparse
import csv
import json
import math
import os
import pathlib
import subprocess
import tempfile

OPTIONS = pathlib.Path(__file__).resolve().parents[2] / "options"
SMALLEST, LEAST, MOST = 1000, 0.8, 1.35
LIMIT, SURE = 4, 20  # times as many unknowns for the limit of a potential; its bar is this part of the error squared
RATIOS = (-6, -3, 0, 3, 6)  # of stiffness, powers of ten
MESHES = {2: {1: 10, 2: 10}, 3: {1: 6, 2: 5}}  # with an exact displacement, by dimension and order
ADAPT = "../tests/adapt/"
GAUSS = "-upper_dm_plex_box_faces 4,2 -lower_dm_plex_box_faces 3,2"
QUARTER = "1.5707963267948966"


def solve4(rows):
    """Gauss elimination of four equations, each a list of coefficients and the right side."""
    rows = [list(row) for row in rows]
    for i in range(4):
        best = max(range(i, 4), key=lambda k: abs(rows[k][i]))
        rows[i], rows[best] = rows[best], rows[i]
        for k in range(4):
            if k != i:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return [rows[i][4] / rows[i][i] for i in range(4)]


def lame(power, inner, outer, overlap, pressure):
    """(A, B) of u = A r + B r^(1-power) in both bodies: power 2 of rings in plane strain, 3 of shells; radii 1, 2, 3.5."""

    def stress(young, poisson, r):  # of A and of B
        grown = young / ((1 + poisson) * (1 - 2 * poisson)) if power == 2 else young / (1 - 2 * poisson)
        return grown, -(power - 1) * young / (1 + poisson) / r**power

    bore, rim, inside, outside = stress(*inner, 1), stress(*outer, 3.5), stress(*inner, 2), stress(*outer, 2)
    move = [2, 2 ** (1 - power)]
    a, b, c, d = solve4([
        [*bore, 0, 0, -pressure],
        [0, 0, *rim, 0],
        [*inside, -outside[0], -outside[1], 0],
        [-move[0], -move[1], *move, overlap],
    ])
    return (a, b), (c, d)


def round_bodies(power, ratio, overlap, pressure, places, square, still=""):
    """Options of an outer body 10^ratio times as stiff as by the scene, and both exact displacements."""
    young = 1000 * 10.0**ratio
    exact = lame(power, (3000, 0.25), (young, 0.3), overlap, pressure)
    text = [",".join(f"({a:.16g}+{b:.16g}/({square})^{power / 2:g})*{x}" for x in places) + still for a, b in exact]
    return ["-outer_young", f"{young:.16g}", "-inner_exact_displacement", text[0], "-outer_exact_displacement", text[1]]


def roles(pair, first, second):
    """Name of the nonmortar side -> options."""
    return {body.split(":")[0]: [f"-{pair}_nonmortar", body, f"-{pair}_mortar", other] for body, other in ((first, second), (second, first))}


def scenes():
    """(name, options file, options, dimension, whether the displacement is known), without order and cells."""
    for role, sides in roles("joint", "lower:top", "upper:bottom").items():
        for ratio in RATIOS:
            yield f"two plates, upper 1e{ratio}, {role} nonmortar", "two_plates", ["-upper_dm_plex_box_faces", "3,3", "-lower_dm_plex_box_faces", "2,2", "-upper_young", f"8e9*1e{ratio}", *sides], 2, False
    kinds = (("rings", "rings", "fit", 2, 1e-3, 0, "xy", "x^2+y^2"), ("tied rings", f"{ADAPT}tied_rings", "bond", 2, 0, 1, "xy", "x^2+y^2"),
             ("shells about the axis", "shells", "fit", 3, 1e-3, 0, "rz", "r^2+z^2"))
    cells = ["-outer_dm_plex_box_faces", "3,5", "-inner_dm_plex_box_faces", "2,4"]
    for name, file, pair, power, overlap, pressure, places, square in kinds:
        for role, sides in roles(pair, "outer:left", "inner:right").items():
            for ratio in RATIOS:
                yield f"{name}, outer 1e{ratio}, {role} nonmortar", file, [*cells, *round_bodies(power, ratio, overlap, pressure, places, square), *sides], 2, True
    yield "annulus", f"{ADAPT}annulus", [], 2, True
    yield "edge2d", "edge2d", GAUSS.split(), 2, True
    for name in ("manufactured_full", "manufactured_partial"):
        yield name, name, "-upper_dm_plex_box_faces 4,4 -lower_dm_plex_box_faces 3,3".split(), 2, True
    yield "manufactured_solid", "manufactured_solid", "-upper_dm_plex_box_faces 2,2,2 -lower_dm_plex_box_faces 3,3,3".split(), 3, True
    small = ["-outer_dm_plex_box_faces", "2,2,2", "-inner_dm_plex_box_faces", "2,2,2"]
    for role, sides in roles("fit", "outer:bottom", "inner:top").items():
        for ratio in RATIOS:
            yield f"shells in space, outer 1e{ratio}, {role} nonmortar", "shells3d", [*small, *round_bodies(3, ratio, 1e-3, 0, "xyz", "x^2+y^2+z^2"), *sides], 3, True
    for name, faces in (("", ("2,3,1", "1,2,1")), (" from finer cells", ("3,5,2", "2,4,2"))):
        boxes = []
        for body, lower, upper, face in (("outer", 2, 3.5, faces[0]), ("inner", 1, 2, faces[1])):
            boxes += [f"-{body}_dm_plex_box_faces", face, f"-{body}_dm_plex_box_lower", f"{lower},0,0", f"-{body}_dm_plex_box_upper", f"{upper},{QUARTER},1",
                      f"-{body}_map", "x*cos(y), x*sin(y), z", f"-{body}_bc_normal", "front,back,bottom,top"]
        yield f"rings in space{name}", "rings", ["-model", "solid", "-probe_bore_at", "1,0,0", "-probe_rim_at", "3.5,0,0", *boxes, *round_bodies(2, 0, 1e-3, 0, "xy", "x^2+y^2", ",0")], 3, True
    yield "punch", "punch", [], 2, False
    for name in ("hertz2d", "hertz_axisymmetric", "parabola"):
        yield name, name, [], 2, False
    yield "hertz3d", "hertz3d", "-sphere_dm_plex_box_faces 3,3,2 -block_dm_plex_box_faces 4,4,2".split(), 3, False


def rows():
    """(name, options file, options, dimension, order, whether the displacement is known)."""
    for name, file, options, dim, known in scenes():
        for cells in ("cut", "kept"):
            for order in (2, 1):
                if name == "punch" and cells == "kept":  # triangles
                    continue
                yield f"{name}, order {order}, {cells}", file, [*options, "-order", str(order), *(["-adapt_cells", "kept"] if cells == "kept" else [])], dim, order, known


def quadrilaterals(file, options):
    return [*options, "-ring_dm_plex_simplex", "0"] if file.endswith("annulus") and "kept" in options else options


def run(program, file, options, folder):
    done = subprocess.run([program, "-options_file", f"{file}.opts", *options, "-quiet", "-output", folder / "result"], cwd=OPTIONS, capture_output=True, text=True, check=False)
    summary = folder / "result.json"
    if not summary.is_file():
        raise SystemExit(done.stderr)
    return json.loads(summary.read_text())["estimate"]


def known_error(program, file, options, folder, meshes):
    """(unknowns, estimate over error) of each mesh."""
    estimate = run(program, file, [*options, "-study", "adaptive", "-study_levels", str(meshes)], folder)
    with open(folder / "result_study.csv", encoding="utf-8") as table:
        errors = [float(line["energy_error"]) for line in csv.DictReader(table)]
    for mesh, error in zip(estimate["meshes"], errors):
        yield mesh["unknowns"], mesh["estimate"] / error


def find_limit(program, file, options, folder, largest):
    """(limit of the potential, its bar) on finer meshes of order 2. It does not depend on order, cells and roles."""
    options = [*options[: options.index("-order")], "-order", "2"]
    potential = run(program, file, [*options, "-adapt", "1e-7", "-adapt_max_meshes", "25", "-adapt_max_unknowns", str(LIMIT * largest)], folder)["potential"]
    return potential["value"], potential["bar"]


def limit_error(program, file, options, folder, largest, limit):
    """(unknowns, estimate over error) of each mesh that counts. 2 (J_h - J) = |e|^2 + L, where L is small."""
    estimate = run(program, file, [*options, "-adapt", "1e-7", "-adapt_max_meshes", "25", "-adapt_max_unknowns", str(largest)], folder)
    for mesh in estimate["meshes"][1:]:
        squared = 2 * (mesh["potential"] - limit[0])
        if squared > SURE * 2 * limit[1]:
            yield mesh["unknowns"], mesh["estimate"] / math.sqrt(squared)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("name", nargs="*")
    parser.add_argument("--largest", type=float, default=3e4)
    parser.add_argument("--each", action="store_true")
    chosen, every, limits = parser.parse_intermixed_args(), [], {}
    print("| scene | meshes | effectivity |\n|---|---:|---:|")
    for name, file, options, dim, order, known in rows():
        if chosen.name and not any(all(word in name.replace(",", "").split() for word in wanted.split()) for wanted in chosen.name):
            continue
        with tempfile.TemporaryDirectory() as folder:
            what = chosen.program.resolve(), file, quadrilaterals(file, options), pathlib.Path(folder)
            group = name.split(", order")[0].replace("upper nonmortar", "lower nonmortar")
            if not known and group not in limits:
                limits[group] = find_limit(*what, chosen.largest)
            found = list(known_error(*what, MESHES[dim][order]) if known else limit_error(*what, chosen.largest, limits[group]))
        found = [mesh for mesh in found if mesh[0] > SMALLEST]
        values = [value for _, value in found]
        every += values
        mark = "" if all(LEAST <= value <= MOST for value in values) else " *"
        print(f"| {name} | {len(values)} | {min(values):.2f} to {max(values):.2f}{mark} |" if values else f"| {name} | 0 | |", flush=True)
        if chosen.each:
            print("  " + ", ".join(f"{unknowns}: {value:.2f}" for unknowns, value in found), flush=True)
    inside = sum(LEAST <= value <= MOST for value in every)
    if every:
        print(f"| all | {len(every)} | {inside} from {LEAST} to {MOST} |")


if __name__ == "__main__":
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    main()
