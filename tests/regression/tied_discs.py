"""Kirchhoff's plate, either side nonmortar; what shear adds is of the order of the square of thickness over radius, 1e-3."""
from judge import near


def judge(run):
    roles = run.again("-joint_nonmortar", "lower:top", "-joint_mortar", "upper:bottom", name="roles")
    for side in (run, roles):
        near("deflection of the middle", side.probe("middle")["displacement"], [0, -6.5625e-4], relative=3e-3)
