"""Work of the loads per radian about the edge."""
from judge import near


def judge(run):
    near("work", run.summary["solvability"]["work"], 0.03 * 0.9 - 0.43 * 0.05, relative=1e-9)
    motion = run.summary["solvability"]["motion"]["plank"]
    near("centre", motion["centre"], [0.05, 0], absolute=1e-9)
    near("turn", motion["rotation"], -1, absolute=1e-9)
