"""A stiff body touches a soft one at few nodes; the mesh has one level. Coarser levels have contact by truncation alone, and their smoothers
must converge."""
from judge import require

MOST = 40  # iterations of CG for all systems together


def judge(run):
    solver = run.summary["solver"]
    require(0 < solver["linear_iterations"] <= MOST, f"{solver['linear_iterations']} iterations")
    require(solver["work_units"] > 0, "no multigrid")
