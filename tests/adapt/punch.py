"""Calibrated estimate over true error of a flat punch, on a mesh that is graded to its edges. What few singular cells lose says little of the
others."""
from effectivity import require_all
from judge import Run, near, require


def judge(run):
    solved = Run(run.program, run.mpiexec, run.ranks, run.folder / "finer", run.arguments[:-1] + ["1e-7", "-adapt_max_meshes", "8"])
    require_all(solved, "flat punch")
    unknowns = [mesh["unknowns"] for mesh in solved.summary["estimate"]["meshes"]]
    for k, last in enumerate(unknowns):
        require(sum(unknowns[: k + 1]) <= 3 * last, f"{unknowns[: k + 1]}: the mesh of the file grows too slowly")
    potential = solved.summary["estimate"]["potential"]
    require(potential["bar"] < 1e-6 * potential["value"], f"{potential}")
    near("potential, half the force times the depth", potential["value"], 10.52784 * 0.01 / 2, absolute=1.5e-7)  # independent solution
