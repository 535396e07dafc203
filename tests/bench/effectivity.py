#!/usr/bin/env python3
"""effectivity.py <mortise> -- calibrated estimate over true error in the energy norm, on all adaptive meshes with more than 1000 unknowns.

Two plates with ratios of stiffness from 1e-6 to 1e6 in both roles and orders, and shells, against the limit of the finest mesh. 2 (J_h - J) = |e|^2 +
L gives the true error of a mesh from its potential energy, where L is small. Meshes count while their error is five times that of the finest one at
least. Scenes with an exact displacement against the error that the program integrates. Prints a table: range and number of meshes."""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

OPTIONS = pathlib.Path(__file__).resolve().parents[2] / "options"
PLATES = "-upper_dm_plex_box_faces 3,3 -lower_dm_plex_box_faces 2,2"
SMALLEST, FARTHER = 1000, 5
EDGE = "-upper_dm_plex_box_faces 4,2 -lower_dm_plex_box_faces 3,2"
BLOCKS = "-upper_dm_plex_box_faces 4,4 -lower_dm_plex_box_faces 3,3"
# Lame's displacements, factor of (x, y); those of the annulus and of edge2d stand in their scenes
OUTER, INNER = "1.3e-3*0.192374956278*4/8.25*(0.4+12.25/(x^2+y^2))", "-1.25/3000*0.192374956278*4/3*(0.5+1/(x^2+y^2))"
RINGS = f"-outer_dm_plex_box_faces 3,5 -inner_dm_plex_box_faces 2,4 -outer_exact_displacement {OUTER}*x,{OUTER}*y -inner_exact_displacement {INNER}*x,{INNER}*y"
# scene -> options file, arguments, order, meshes
EXACT = {
    "edge2d": ("edge2d", EDGE, 2, 13),
    "edge2d, order 1": ("edge2d", EDGE, 1, 12),
    "manufactured, full contact": ("manufactured_full", BLOCKS, 2, 11),
    "manufactured, partial contact": ("manufactured_partial", BLOCKS, 2, 11),
    "rings": ("rings", RINGS, 2, 12),
    "rings, kept": ("rings", f"{RINGS} -adapt_cells kept", 2, 12),
    "tied rings, kept": ("../tests/adapt/tied_rings", "-adapt_cells kept", 2, 10),
    "annulus, kept": ("../tests/adapt/annulus", "-ring_dm_plex_simplex 0 -adapt_cells kept", 2, 12),
    "annulus": ("../tests/adapt/annulus", "", 2, 12),
    "annulus, order 1": ("../tests/adapt/annulus", "", 1, 12),
}
PUNCH = ("punch", "", 11)
SHELLS = ("shells3d", "-outer_dm_plex_box_faces 2,2,2 -inner_dm_plex_box_faces 2,2,2", 5)


def solve(program, name, arguments, meshes):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "result.json"
        subprocess.run([program, "-options_file", f"{name}.opts", *arguments.split(), "-adapt", "1e-7", "-adapt_max_meshes", str(meshes), "-quiet",
                        "-adapt_max_unknowns", "1.5e5", "-summary", file], cwd=OPTIONS, capture_output=True, check=False)
        return json.loads(file.read_text())


def judge(summary):
    """Estimate over error of each mesh that counts; the estimate of the first one has no calibration."""
    limit, meshes = summary["estimate"]["potential"]["value"], summary["estimate"]["meshes"]
    last = meshes[-1]["estimate"]
    for mesh in meshes[1:]:
        squared = 2 * (mesh["potential"] - limit)
        if mesh["unknowns"] > SMALLEST and mesh["estimate"] > FARTHER * last and squared > 0:
            yield mesh["estimate"] / math.sqrt(squared)


def study(program, file, arguments, order, meshes):
    """Estimate over error of each mesh."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "-options_file", f"{file}.opts", *arguments.split(), "-order", str(order), "-study", "adaptive", "-study_levels", str(meshes),
                        "-quiet", "-output", f"{folder}/result"], cwd=OPTIONS, capture_output=True, check=False)
        estimate = json.loads(pathlib.Path(f"{folder}/result.json").read_text())["estimate"]
        with open(f"{folder}/result_study.csv", encoding="utf-8") as table:
            errors = [float(line["energy_error"]) for line in csv.DictReader(table)]
    return [mesh["estimate"] / error for mesh, error in zip(estimate["meshes"], errors) if mesh["unknowns"] > SMALLEST]


def row(name, found):
    found = list(found)
    print(f"| {name} | {len(found)} | {min(found):.2f} to {max(found):.2f} |" if found else f"| {name} | 0 | |", flush=True)
    return found


def main():
    program, every = pathlib.Path(sys.argv[1]).resolve(), []
    print("| scene | meshes | effectivity |\n|---|---:|---:|")
    for order in (2, 1):
        for exponent in (-6, -3, 0, 3, 6):
            for role in ("lower", "upper"):
                other = "upper" if role == "lower" else "lower"
                sides = f"-joint_nonmortar {role}:{'top' if role == 'lower' else 'bottom'} -joint_mortar {other}:{'bottom' if role == 'lower' else 'top'}"
                summary = solve(program, "two_plates", f"{PLATES} -order {order} -upper_young 8e9*1e{exponent} {sides}", 18 if order == 2 else 15)
                every += row(f"two plates, order {order}, upper 1e{exponent} times as stiff, {role} nonmortar", judge(summary))
    for name, scene in EXACT.items():
        every += row(name, study(program, *scene))
    every += row("flat punch, from a graded mesh", judge(solve(program, *PUNCH)))
    every += row("spherical shells", judge(solve(program, *SHELLS)))
    inside = sum(0.8 <= effectivity <= 1.35 for effectivity in every)
    print(f"| all | {len(every)} | {100 * inside / len(every):.1f} % between .8 and 1.35 |")


if __name__ == "__main__":
    main()
