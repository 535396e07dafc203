"""Nested iteration for a body that contact alone holds: the finest level starts with the right set, and few proximal steps are needed."""
from judge import require

from multigrid import judge as agree

STEPS = 5  # on the finest mesh, all sweeps of springs together; 9 without coarser ones


def judge(run):
    agree(run)
    steps = run.again("-pc_type", "truncatedmg", name="steps").summary["solver"]["iterations"]
    require(steps <= STEPS, f"{steps} steps on the finest mesh")
