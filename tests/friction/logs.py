"""Three logs held by friction alone, which stand on edges of their meshes. Without friction the heap falls apart; the rigid motion that closed the gaps first did so, by a thousand times the
largest gap, and its roundoff was left: the certificate failed (exit code 3), after 18 Newton steps."""
import math

from judge import near, require

WEIGHT = 0.5 * 50 * math.sin(2 * math.pi / 50) * (1 - 0.3**2)  # of the mesh
MOST = 12  # Newton steps, with those of the proximal point iteration


def judge(run):
    floors, joints = ([run.pair(f"{name}_{side}") for side in ("left", "right")] for name in ("floor", "joint"))
    near("weight on the floor", [pair["normal_force"] for pair in floors], [1.5 * WEIGHT] * 2, relative=1e-6)
    near("spread", floors[0]["tangential_force"][0], -floors[1]["tangential_force"][0], relative=1e-5)
    up = [pair["force"][1] for pair in joints]
    near("weight on the lower logs", up, [-0.5 * WEIGHT] * 2, relative=1e-6)
    require(max(run.summary["solver"]["kkt"].values()) < 1e-9, f"{run.summary['solver']['kkt']}")
    require(run.summary["solver"]["iterations"] <= MOST, f"{run.summary['solver']['iterations']} Newton steps")
