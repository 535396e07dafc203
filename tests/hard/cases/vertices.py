"""Vertices alone carry; the rest of the side carries a pressure that is given."""
from uniform import judge_uniform


def judge(run):
    judge_uniform(run, ["joint"], accuracy=1e-9)
