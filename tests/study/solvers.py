"""Both solvers begin at the coarser solution and find the same, active sets included; steps are their own business."""
from judge import near, same
from studies import block, rows, tolerance


def judge(run):
    other = rows(run.again("-snes_type", "vinewtonrsls"))
    for row, reference in zip(other, rows(run)):
        same("active", row["active"], reference["active"])
        for name in ("potential", "joint_normal_force", "middle_displacement_x", "middle_von_mises", "energy_error_to_finest"):
            if reference[name] == reference[name]:
                near(name, row[name], reference[name], absolute=tolerance(reference, name, 1e-9))
    same("runs", len(other), len(block(run)["runs"]))
