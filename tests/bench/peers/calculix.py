"""Hertz' contact in the plane by Mortise and by CalculiX (ccx): the same nodes, cells, supports and materials. Processor seconds for a largest
pressure to so many percent.

    calculix.py <mortise> [<refinements>]

Mortise writes the mesh of options/hertz2d_graded.opts; this script writes it as an input of CalculiX: one layer of C3D8 or C3D20 that cannot move
across (its plane cells become such layers, too). Contact is from surface to surface with a linear penalty, of three stiffnesses the one with the
smallest error. (Its mortar method stops in the solver of Debian's package.) The reference is the last solution of Mortise of order 2 on cells half as
large as the finest here. One thread each, processor seconds with the start of the program."""
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile

import h5py
import numpy as np

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "options", "hertz2d_graded.opts")
MATERIALS = {0: (210000, 0.3), 1: (70000, 0.33)}
RADIUS, DEPTH, APPROACH = 10.0, 20.0, 0.05
NEAR = 1e-9  # of the radius: which nodes are on a side
REPEATS = 3
STIFFNESSES = ("1e6", "1e7", "1e8")  # of the penalty, in the scene's units


def timed(command, folder):
    """Processor seconds and output."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False,
                          env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.returncode, done.stdout


def mortise(program, folder, order, refinements, repeats=REPEATS):
    """Median seconds, unknowns and the largest pressure; leaves result.h5."""
    seconds = []
    for _ in range(repeats):
        time, code, text = timed([program, "-options_file", SCENE, "-order", str(order), "-dm_refine", str(refinements), "-output", "result"], folder)
        if code:
            sys.exit(f"mortise: {text}")
        seconds.append(time)
    return statistics.median(seconds), int(re.search(r"(\d+) unknowns", text)[1]), float(re.search(r"largest pressure (\S+)", text)[1])


def faces(cells, inside):
    """Cell and number of the facet over each edge with both corners in a set of nodes."""
    return [(c + 1, k + 3) for c, cell in enumerate(cells) for k in range(4) if inside[cell[k]] and inside[cell[(k + 1) % 4]]]


def element(number, cell, size):
    """The layer over a plane cell: below, above; with order 2 the middles of edges below, above and between."""
    below, above = [n + 1 for n in cell], [size + n + 1 for n in cell]
    nodes = below[:4] + above[:4] + below[4:] + above[4:]
    if len(cell) > 4:
        nodes += [2 * size + n + 1 for n in cell[:4]]
    words = [str(n) for n in [number, *nodes]]
    return ",".join(words[:11]) + (",\n" + ",".join(words[11:]) if len(words) > 11 else "") + "\n"


def write_input(folder, stiffness):
    with h5py.File(os.path.join(folder, "result.h5")) as file:
        points, cells, body = file["points"][:], file["cells"][:], file["body"][:]
    used = 4 if cells.shape[1] == 4 else 8
    cells, x, y = cells[:, :used], points[:, 0], points[:, 1]
    of_disc = np.zeros(len(points), bool)
    of_disc[cells[body == 0].ravel()] = True
    near = NEAR * RADIUS
    on = {"arc": of_disc & (abs(np.hypot(x, y - RADIUS) - RADIUS) < near), "top": ~of_disc & (abs(y) < near)}
    nodes = {"axis": abs(x) < near, "driven": of_disc & (abs(y - RADIUS) < near), "bottom": ~of_disc & (abs(y + DEPTH) < near)}
    kept = np.zeros(len(points), bool)
    kept[cells.ravel()] = True
    size, corner = len(points), np.zeros(len(points), bool)
    corner[cells[:, :4].ravel()] = True
    with open(os.path.join(folder, "hertz.inp"), "w", encoding="ascii") as out:
        out.write("*NODE, NSET=ALL\n")
        for layer, z in enumerate((0, 1, 0.5)[:2 if used == 4 else 3]):
            has = corner if layer == 2 else kept
            out.writelines(f"{layer * size + i + 1},{p[0]:.12e},{p[1]:.12e},{z}\n" for i, p in enumerate(points) if has[i])
        for b, (young, poisson) in MATERIALS.items():
            out.write(f"*ELEMENT, TYPE=C3D{8 if used == 4 else 20}, ELSET=BODY{b}\n")
            out.writelines(element(c + 1, cells[c], size) for c in np.flatnonzero(body == b))
            out.write(f"*MATERIAL, NAME=M{b}\n*ELASTIC\n{young},{poisson}\n*SOLID SECTION, ELSET=BODY{b}, MATERIAL=M{b}\n")
        for name, inside in nodes.items():
            out.write(f"*NSET, NSET={name.upper()}\n")
            for layer in range(2 if used == 4 else 3):
                out.writelines(f"{layer * size + i + 1},\n" for i in np.flatnonzero(inside & (corner if layer == 2 else kept)))
        for name, inside in on.items():
            out.write(f"*SURFACE, NAME={name.upper()}\n")
            out.writelines(f"{cell},S{face}\n" for cell, face in faces(cells, inside))
        out.write(f"*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{stiffness},0.\n"
                  "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nARC,TOP\n"
                  "*BOUNDARY\nALL,3,3\nAXIS,1,1\nBOTTOM,2,2\n*STEP\n*STATIC\n1.,1.\n"
                  f"*BOUNDARY\nDRIVEN,2,2,{-APPROACH}\n"
                  "*NODE PRINT, NSET=BOTTOM, TOTALS=ONLY\nRF\n*CONTACT FILE\nCSTR\n*END STEP\n")


def largest_pressure(folder):
    """Of the block CONTACT of a .frd file: its fourth component."""
    found, inside = [], False
    with open(os.path.join(folder, "hertz.frd"), encoding="ascii") as file:
        for line in file:
            if line.startswith(" -4"):
                inside = "CONTACT" in line
            elif inside and line.startswith(" -1"):
                found.append(float(line[13 + 36:13 + 48]))
    return max(found) if found else float("nan")


def calculix(folder, repeats=REPEATS):
    """Median seconds and the largest pressure of hertz.inp; infinite where it is not solved."""
    seconds = []
    for _ in range(repeats):
        time, code, text = timed(["ccx", "-i", "hertz"], folder)
        if code or "Job finished" not in text:
            return float("inf"), float("inf")
        seconds.append(time)
    return statistics.median(seconds), largest_pressure(folder)


def main():
    program, finest = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 2
    with tempfile.TemporaryDirectory() as folder:
        _, _, reference = mortise(program, folder, 2, finest + 1, 1)
        print(f"largest pressure {reference:.5g}\n\n| order | unknowns | Mortise s | error % | CalculiX s | error % | stiffness | times as long |")
        print("|---|---:|---:|---:|---:|---:|---:|---:|")
        for order in (1, 2):
            for refinements in range(finest + 1):
                time, unknowns, pressure = mortise(program, folder, order, refinements)
                error = 100 * abs(pressure / reference - 1)
                found = []
                for stiffness in STIFFNESSES:
                    write_input(folder, stiffness)
                    found.append((*calculix(folder), stiffness))
                off, theirs, stiffness = min((100 * abs(p / reference - 1), t, k) for t, p, k in found)
                row = [f"{order}", f"{unknowns}", f"{time:.2f}", f"{error:.2g}", f"{theirs:.2f}", f"{off:.2g}", stiffness, f"{theirs / time:.0f}"]
                print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
