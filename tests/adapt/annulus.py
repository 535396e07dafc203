"""A ring under pressure: calibrated estimate over the true error, which for chords and parabolas is for the most part that of the curve."""
import math

from judge import Run, require, same

POTENTIAL = -1 / 2 * (1.3 / 1000 * 1 / 3 * (0.4 + 4)) * math.pi / 2
FROM = {1: 100, 2: 1500}  # unknowns; of order 2 the estimate of coarser meshes is up to 2.7 times the error


def judge(run):
    for order, fewest in FROM.items():
        solved = Run(run.program, run.mpiexec, run.ranks, run.folder / f"order_{order}", run.arguments + ["-order", f"{order}", "-adapt", "1e-6", "-adapt_max_unknowns", "2e4"])
        same("exit", solved.exit, 3)  # by the limit on unknowns
        estimate = solved.summary["estimate"]
        judged = [mesh for mesh in estimate["meshes"] if mesh["unknowns"] > fewest]
        require(len(judged) >= 4, f"order {order}: {len(judged)} meshes")
        for mesh in judged:
            effectivity = mesh["estimate"] / math.sqrt(2 * abs(mesh["potential"] - POTENTIAL))
            require(0.8 <= effectivity <= 1.35, f"order {order}, {mesh['unknowns']} unknowns: effectivity {effectivity}")
        off = abs(estimate["potential"]["value"] - POTENTIAL)
        require(off <= estimate["potential"]["bar"], f"order {order}: potential off by {off}, bar {estimate['potential']['bar']}")
