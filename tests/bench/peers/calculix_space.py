"""Hertz' contact in space by Mortise and by CalculiX (ccx): options/hertz3d.opts with the same nodes, cells, supports and materials. Processor
seconds for a largest pressure to so many percent.

    calculix_space.py <mortise>

Cells are C3D8 or C3D20 (of Mortise's 27 nodes those on edges); contact is from surface to surface with a linear penalty, of the stiffness among
STIFFNESSES with the smallest error. The reference is Mortise's solution of order 2 on cells half as large. One thread each, processor seconds with
the start of the program."""
import os
import re
import statistics
import sys
import tempfile

import h5py
import numpy as np

from calculix import calculix, timed

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "options", "hertz3d.opts")
MATERIALS = {0: (210000, 0.3), 1: (70000, 0.33)}
RADIUS, DEPTH, APPROACH = 10.0, 3.0, 0.0083
NEAR = 1e-6  # how far from a plane or the sphere the nodes of a side are
STIFFNESSES = ("1e6", "1e7", "1e8")  # of the penalty, in the scene's units
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]  # of C3D20, in its order
FACES = [(0, 1, 2, 3), (4, 7, 6, 5), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]  # S1 to S6
CASES = [(1, 0, 3), (1, 1, 1), (2, 0, 1)]  # order, refinements, repeats


def mortise(program, folder, order, refinements, repeats):
    """Median seconds, unknowns and the largest pressure; leaves result.h5."""
    seconds = []
    for _ in range(repeats):
        time, code, text = timed([program, "-options_file", SCENE, "-order", str(order), "-dm_refine", str(refinements), "-output", "result"], folder)
        if code:
            sys.exit(f"mortise: {text}")
        seconds.append(time)
    return statistics.median(seconds), int(re.search(r"(\d+) unknowns", text)[1]), float(re.search(r"largest pressure (\S+)", text)[1])


def nodes_of_c3d20(points, cells):
    """Cells with the nodes of C3D20: the corners, and for each edge the node that lies nearest to its middle."""
    if cells.shape[1] == 8:
        return cells
    cell = points[cells[0]]
    middles = [int(np.argmin(np.linalg.norm(cell[8:] - (cell[a] + cell[b]) / 2, axis=1))) + 8 for a, b in EDGES]
    return cells[:, [*range(8), *middles]]


def write_input(folder, stiffness):
    with h5py.File(os.path.join(folder, "result.h5")) as file:
        points, cells, body = file["points"][:], file["cells"][:], file["body"][:]
    cells = nodes_of_c3d20(points, cells)
    x, y, z = points.T
    of_sphere, used = np.zeros(len(points), bool), np.zeros(len(points), bool)
    of_sphere[cells[body == 0].ravel()] = True
    used[cells.ravel()] = True
    on = {"SPHERE": used & of_sphere & (abs(np.linalg.norm(points - [0, 0, RADIUS], axis=1) - RADIUS) < NEAR),
          "TOP": used & ~of_sphere & (abs(z) < NEAR)}
    nodes = {"LEFT": used & (abs(x) < NEAR), "FRONT": used & (abs(y) < NEAR), "BOTTOM": used & ~of_sphere & (abs(z + DEPTH) < NEAR),
             "DRIVEN": used & of_sphere & (abs(z - DEPTH) < NEAR)}
    with open(os.path.join(folder, "hertz.inp"), "w", encoding="ascii") as out:
        out.write("*NODE, NSET=ALL\n")
        out.writelines(f"{i + 1},{p[0]:.12e},{p[1]:.12e},{p[2]:.12e}\n" for i, p in enumerate(points) if used[i])
        for b, (young, poisson) in MATERIALS.items():
            out.write(f"*ELEMENT, TYPE=C3D{cells.shape[1]}, ELSET=BODY{b}\n")
            for c in np.flatnonzero(body == b):
                words = [str(n) for n in (c + 1, *(cells[c] + 1))]
                out.write(",".join(words[:11]) + (",\n" + ",".join(words[11:]) if len(words) > 11 else "") + "\n")
            out.write(f"*MATERIAL, NAME=M{b}\n*ELASTIC\n{young},{poisson}\n*SOLID SECTION, ELSET=BODY{b}, MATERIAL=M{b}\n")
        for name, inside in nodes.items():
            out.write(f"*NSET, NSET={name}\n" + "".join(f"{n + 1},\n" for n in np.flatnonzero(inside)))
        for name, inside in on.items():
            out.write(f"*SURFACE, NAME={name}\n")
            out.writelines(f"{c + 1},S{k + 1}\n" for c, cell in enumerate(cells) for k, face in enumerate(FACES) if inside[cell[list(face)]].all())
        out.write(f"*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{stiffness},0.\n"
                  "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nSPHERE,TOP\n"
                  "*BOUNDARY\nLEFT,1,1\nFRONT,2,2\nBOTTOM,3,3\n*STEP\n*STATIC\n1.,1.\n"
                  f"*BOUNDARY\nDRIVEN,3,3,{-APPROACH}\n*CONTACT FILE\nCSTR\n*END STEP\n")


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        _, _, reference = mortise(program, folder, 2, 1, 1)
        print(f"largest pressure {reference:.5g}\n\n| order | unknowns | Mortise s | error % | CalculiX s | error % | stiffness | times as long |")
        print("|---|---:|---:|---:|---:|---:|---:|---:|", flush=True)
        for order, refinements, repeats in CASES:
            time, unknowns, pressure = mortise(program, folder, order, refinements, repeats)
            error = 100 * abs(pressure / reference - 1)
            found = []
            for stiffness in STIFFNESSES:
                write_input(folder, stiffness)
                found.append((*calculix(folder, repeats), stiffness))
            off, theirs, stiffness = min((100 * abs(p / reference - 1), t, k) for t, p, k in found)
            row = [f"{order}", f"{unknowns}", f"{time:.2f}", f"{error:.2g}", f"{theirs:.2f}", f"{off:.2g}", stiffness, f"{theirs / time:.0f}"]
            print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
