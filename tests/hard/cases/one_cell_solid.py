"""Uniform stress: pressure 1 at every node that carries one; cells of all kinds."""
from uniform import judge_cells


def judge(run):
    judge_cells(run, -0.5 * (1 / 1000 + 1 / 2000))
