"""Half of the ring's weight; edges of order 2 leave the area right to 1e-6."""
from math import pi

from judge import near


def judge(run):
    near("force", run.pair("pin")["force"][1], 1.5 * pi, relative=1e-6)
