"""Pull less weight."""
from math import pi

from judge import near


def judge(run):
    near("work", run.summary["solvability"]["work"], 0.1 * pi, relative=1e-9)
