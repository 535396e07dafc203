"""Forces along the axis."""
from math import pi

from judge import near


def judge(run):
    near("force below", run.pair("below")["force"], [0, 2 * pi], absolute=1e-9)
    near("force above", run.pair("above")["force"], [0, -2 * pi], absolute=1e-9)
