"""Volume of a truncated cone with radii 0.2 and 0.7."""
from math import pi

from judge import near


def judge(run):
    near("force", run.pair("joint")["force"][1], pi / 3 * (0.2**2 + 0.2 * 0.7 + 0.7**2), relative=1e-10)
