"""Multigrid on levels of some of the nodes where a stiff body touches a soft one with few nodes: levels below the finest know of contact by
truncation alone, which must not lead their smoothers astray."""
from judge import require

MOST = 40  # iterations of CG for all systems together


def judge(run):
    solver = run.summary["solver"]
    require(0 < solver["linear_iterations"] <= MOST, f"{solver['linear_iterations']} iterations")
    require(solver["work_units"] > 0, "no multigrid")
