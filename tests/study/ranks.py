"""The same numbers on every number of ranks."""
from studies import judge_files, judge_same


def judge(run):
    judge_files(run, orders=(1, 2), levels=3)
    judge_same(run, run.again(ranks=1), relative=1e-9)
