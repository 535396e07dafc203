"""Area 2 (0.2 + 1 / (2 sqrt 3)); two forces along the walls' normals."""
from math import sqrt

from judge import near


def judge(run):
    weight = 2 * (0.2 + 0.5 / sqrt(3))
    for wall, sign in (("left", 1), ("right", -1)):
        near(wall, run.pair(wall)["force"], [sign * weight / 2 * sqrt(3), weight / 2], absolute=1e-10)
