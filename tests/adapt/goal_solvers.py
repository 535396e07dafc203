"""Dual problems by every solver, and on one rank: the same meshes, values and dual estimates."""
from judge import near, same


def judge(run):
    mine = run.summary["estimate"]
    others = [run.again(*arguments, name=arguments[-1].strip("-"), ranks=1) for arguments in (["-snes_pdas_reduce", "0"], ["-pc_type", "truncatedmg"], ["-snes_type", "vinewtonrsls"], ["-cross_check"])]
    for other in others:
        estimate = other.summary["estimate"]
        same("cells", [mesh["cells"] for mesh in estimate["meshes"]], [mesh["cells"] for mesh in mine["meshes"]])
        for a, b in zip(estimate["goals"], mine["goals"]):
            near(a["goal"], a["value"], b["value"], relative=1e-8)
            near("its dual estimate", a["dual_estimate"], b["dual_estimate"], relative=1e-4)
