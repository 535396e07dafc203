"""What is left of the loads."""
from judge import near


def judge(run):
    near("work", run.summary["solvability"]["work"], 1e-6, absolute=1e-9)  # of works of 1
