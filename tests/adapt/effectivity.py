"""Calibrated estimate over true error on two plates of very different stiffness, either side nonmortar."""
import math

from judge import Run, require, same

SIDES = {"upper": "upper:bottom", "lower": "lower:top"}


def require_all(solved, what):
    """Against the limit of the finest mesh; the estimate of the first mesh has no calibration."""
    same("exit", solved.exit, 3)  # by the limit on meshes
    limit, meshes = solved.summary["estimate"]["potential"]["value"], solved.summary["estimate"]["meshes"]
    judged = [mesh for mesh in meshes[1:] if mesh["unknowns"] > 1000 and mesh["estimate"] > 5 * meshes[-1]["estimate"]]
    require(len(judged) >= 3, f"{what}: {len(judged)} meshes")
    for mesh in judged:
        effectivity = mesh["estimate"] / math.sqrt(2 * (mesh["potential"] - limit))
        require(0.8 <= effectivity <= 1.35, f"{what}, {mesh['unknowns']} unknowns: effectivity {effectivity}")


def judge(run):
    for exponent in (-6, 6):
        for role, other in (("upper", "lower"), ("lower", "upper")):
            scene = ["-upper_young", f"8e9*1e{exponent}", "-joint_nonmortar", SIDES[role], "-joint_mortar", SIDES[other], "-adapt", "1e-7", "-adapt_max_meshes", "15"]
            require_all(Run(run.program, run.mpiexec, run.ranks, run.folder / f"{role}_{exponent}", run.arguments + scene), f"upper 1e{exponent}, {role} nonmortar")
