"""Three motions of both, and sliding."""
from judge import near
from uniform import judge_uniform


def judge(run):
    judge_uniform(run, ["joint"], accuracy=1e-9)
    near("free motions", len(run.summary["solvability"]["free_motions"]), 4)
