"""Weight times the fall per unit of length."""
from judge import near


def judge(run):
    near("work", run.summary["solvability"]["work"], 0.6, relative=1e-9)
