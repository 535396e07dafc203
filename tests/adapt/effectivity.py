"""Calibrated estimate over true error on two plates of very different stiffness, either side nonmortar."""
import math

from judge import Run, require, same

SIDES = {"upper": "upper:bottom", "lower": "lower:top"}


def judge(run):
    for exponent in (-6, 6):
        for role, other in (("upper", "lower"), ("lower", "upper")):
            scene = ["-upper_young", f"8e9*1e{exponent}", "-joint_nonmortar", SIDES[role], "-joint_mortar", SIDES[other], "-adapt", "1e-7", "-adapt_max_meshes", "15"]
            solved = Run(run.program, run.mpiexec, run.ranks, run.folder / f"{role}_{exponent}", run.arguments + scene)
            same("exit", solved.exit, 3)  # by the limit on meshes
            summary = solved.summary
            limit, meshes = summary["estimate"]["potential"]["value"], summary["estimate"]["meshes"]
            judged = [mesh for mesh in meshes if mesh["unknowns"] > 1000 and mesh["estimate"] > 5 * meshes[-1]["estimate"]]
            require(len(judged) >= 3, f"upper 1e{exponent}, {role} nonmortar: {len(judged)} meshes")
            for mesh in judged:
                effectivity = mesh["estimate"] / math.sqrt(2 * (mesh["potential"] - limit))
                require(0.8 <= effectivity <= 1.35, f"upper 1e{exponent}, {role} nonmortar, {mesh['unknowns']} unknowns: effectivity {effectivity}")
