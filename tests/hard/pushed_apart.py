"""An overlap lifts a block that nothing presses back: as a whole, without a force but rounding, and that is a solution."""
import numpy as np

from judge import near, require, same

OVERLAP = 1e-3
STIFFNESS = 2e5  # of the block; a force that would strain it by the overlap over its height is STIFFNESS * OVERLAP


def judge(run):
    same("verdict", run.summary["solvability"]["verdict"], "free_motion")
    same("free motions", len(run.summary["solvability"]["free_motions"]), 3)
    with run.fields() as file:
        points, motion = file["points"][()], file["displacement"][()]
    for what, part, lift in (("table", points[:, 1] < 0, 0.0), ("block", points[:, 1] > 0, OVERLAP)):
        moved = motion[part, :2]
        near(f"displacements of the {what}", moved.ravel(), np.tile([0, lift], len(moved)), absolute=1e-9 * OVERLAP)
    require(abs(run.pair("joint")["normal_force"]) < 1e-9 * STIFFNESS * OVERLAP, str(run.pair("joint")))
