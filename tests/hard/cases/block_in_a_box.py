"""Strain -0.002 along every axis: pressure 0.002 E / ((1 + nu) (1 - 2 nu)), at faces, edges and corners alike."""
from uniform import judge_box


def judge(run):
    judge_box(run, 2 / (1.3 * 0.4), 2)
