"""Uniform tension of 5: the largest pressure of the tie is -5. It is that of all nodes, of which the first by coordinates is named."""
from judge import near


def judge(run):
    joint = run.pair("joint")
    near("largest pressure", joint["max_pressure"], -5, relative=1e-9)
    near("its place", joint["max_pressure_at"], [0, 1], absolute=1e-12)
    near("force on the upper block", joint["force"], [0, -5], absolute=1e-9)
