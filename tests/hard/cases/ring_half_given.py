"""Two roles leave the third one no choice, soft and fine as its body is."""
from ring_of_three import judge_ring


def judge(run):
    judge_ring(run, {"ab": "a", "bc": "b", "ca": "a"})
