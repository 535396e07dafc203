"""A floating roller follows the errors of its gaps: they are no limit of the model, whichever side is nonmortar. Forces are those of statics."""
import math

from judge import near, require

SIDES = {"right_wall": ("roller:bottom", "right:top"), "left_wall": ("roller:left", "left:top")}


def judge(run):
    roles = [argument for pair, (roller, wall) in SIDES.items()
             for argument in (f"-{pair}_nonmortar", wall, f"-{pair}_mortar", roller)]
    for found in (run, run.again(*roles, name="roles", warns=["coarse_contact", "model_limit"])):
        for pair in SIDES:
            near("force of a wall", found.summary["pairs"][pair]["normal_force"], math.pi / math.sqrt(2), relative=1e-3)
        gap = found.summary["validity"]["indicators"]["gap"]
        require(gap["value"] < 0.01, f"the gap's error is {gap}, though the roller follows it")
