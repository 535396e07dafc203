"""Kept cells, a stiff nonmortar side. On the last mesh its pressures alternate from node to node at the loaded corner, which costs no energy."""
import math

from judge import Run, require, same

LIMIT = -3186.80421  # of triangles with 104 828 unknowns, bar 8e-5


def judge(run):
    solved = Run(run.program, run.mpiexec, run.ranks, run.folder, run.arguments)
    same("exit", solved.exit, 3)  # by the limit on meshes
    judged = [mesh for mesh in solved.summary["estimate"]["meshes"] if mesh["unknowns"] > 1000]
    require(len(judged) >= 7, f"{len(judged)} meshes")
    for mesh in judged:
        effectivity = mesh["estimate"] / math.sqrt(2 * (mesh["potential"] - LIMIT))
        require(0.8 <= effectivity <= 1.35, f"{mesh['unknowns']} unknowns: effectivity {effectivity}")
