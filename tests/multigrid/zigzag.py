"""A stiff body that carries the multipliers of a soft one meets every other of its nodes: sets are far from what coarser meshes say, and systems are not
to be solved to more digits than they deserve."""
from judge import require

SETS, ITERATIONS = 11, 45  # with one CG and another some more or less


def judge(run):
    solver = run.summary["solver"]
    require(solver["iterations"] <= SETS, f"{solver['iterations']} sets")
    require(solver["linear_iterations"] <= ITERATIONS, f"{solver['linear_iterations']} iterations")
