"""Work about the line y = 1/8: 1 (1/2 - 1/8) + 1/4 (2/3 - 1/8)."""
from judge import near


def judge(run):
    near("work", run.summary["solvability"]["work"], 0.375 + 0.25 * (2 / 3 - 0.125), relative=1e-9)
