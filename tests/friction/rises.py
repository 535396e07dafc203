"""A rise of the estimated error on coarse meshes ends no refinement: the loop goes on until the error is what was asked for."""
from judge import require


def judge(run):
    errors = [mesh["energy_norm_relative"] for mesh in run.summary["estimate"]["meshes"]]
    rises = [after for before, after in zip(errors, errors[1:]) if after > 1.2 * before]
    require(rises, f"no rise on these meshes, so that nothing is tested: {errors}")
    require(errors[-1] <= 1e-1, f"the last error: {errors[-1]}")
