"""A body that contact alone holds begins on the coarsest mesh as others do: the finest one has the right set at once, and springs that rest where
the coarser solution is need little relaxing."""
from judge import require

from multigrid import judge as agree

STEPS = 5  # on the finest mesh, all sweeps of springs together; 9 without coarser ones


def judge(run):
    agree(run)
    steps = run.again("-pc_type", "truncatedmg", name="steps").summary["solver"]["iterations"]
    require(steps <= STEPS, f"{steps} steps on the finest mesh")
