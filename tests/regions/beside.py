"""Regions of one body meet on the mortar side, where each has a stress of its own. The estimated error does not depend on the order in which they are
listed."""
from judge import near


def judge(run):
    for pair in (("joint_nonmortar", "joint_mortar"), ("joint_mortar", "joint_nonmortar")):
        sides = [f"-{pair[0]}", "block:left", f"-{pair[1]}", "strip:right"]
        first = run.again(*sides, name=pair[0])
        other = run.again(*sides, "-strip_regions", "stiff layer,soft", name=f"{pair[0]}_listed")
        near(f"estimate, block at {pair[0]}", other.summary["estimate"]["energy_norm"], first.summary["estimate"]["energy_norm"], relative=1e-9)
