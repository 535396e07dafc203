"""Displacements that are prescribed on fine meshes make a right-hand side much larger than the forces: residuals are compared with the forces."""
from judge import require


def judge(run):
    left = run.summary["solver"]["kkt"]["equilibrium"]
    require(left < 1e-9, f"equilibrium {left} of the forces")
