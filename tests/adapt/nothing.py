"""The first mesh holds the solution: no error to rounding, one mesh."""
from judge import near, same


def judge(run):
    estimate = run.summary["estimate"]
    same("meshes", len(estimate["meshes"]), 1)
    near("error", estimate["energy_norm_relative"], 0, absolute=1e-9)
