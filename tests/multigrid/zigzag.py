"""A stiff nonmortar body meets every other node of a soft one. Sets differ much from those of coarser meshes, and early systems are solved to
few digits."""
from judge import require

SETS, ITERATIONS = 11, 45  # with one CG and another some more or less


def judge(run):
    solver = run.summary["solver"]
    require(solver["iterations"] <= SETS, f"{solver['iterations']} sets")
    require(solver["linear_iterations"] <= ITERATIONS, f"{solver['linear_iterations']} iterations")
