"""Each joint carries the weights above it."""
from math import pi

from judge import near

WEIGHTS = [pi * (outer**2 - inner**2) for inner, outer in ((0, 1), (0.1, 0.95), (0, 0.9), (0.1, 0.84), (0, 0.8))]


def judge_weights(run):
    for k in range(5):
        near(f"force of joint {k + 1}", run.pair(f"joint{k + 1}")["force"], [0, sum(WEIGHTS[k:])], absolute=1e-9)


def judge(run):
    judge_weights(run)
    judge_weights(run.again("-order", "2", name="quadratic"))
