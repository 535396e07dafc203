"""Uniform stress along the axis: radial displacement is linear, which the cells hold."""
from math import pi

from judge import near


def judge(run):
    for solved in (run, run.again("-order", "2", "-upper_young", "1e8", name="quadratic")):
        near("force", solved.pair("joint")["force"], [0, pi], absolute=1e-8)
        near("potential", solved.summary["energy"]["potential"], -pi / 2 * (1e-3 + 1 / float(solved.summary["options"]["upper_young"])), relative=1e-8)
