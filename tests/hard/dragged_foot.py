"""The indicator of gaps tells what dragging costs of the force: the same column above a ball that was moved instead has the true force."""
from judge import near, require

MESH = 0.015  # of the displacement: errors of gaps that are no linear function of the place


def judge(run):
    plain = run.summary["pairs"]["foot"]["normal_force"]
    for way in (0.02, 0.05, 0.1):
        dragged = run.again("-column_bc_displacement_top", f"{way},-0.02", name=f"dragged_{way}", warns=["model_limit"])
        moved = run.again("-column_bc_displacement_top", "0,-0.02", "-foot_obstacle_point", f"{-way},-2", name=f"moved_{way}", warns=["model_limit"])
        near("linear theory", dragged.summary["pairs"]["foot"]["normal_force"], plain, relative=1e-6)
        true = 1 - moved.summary["pairs"]["foot"]["normal_force"] / plain
        told = dragged.summary["validity"]["indicators"]["gap"]["value"]
        require(0.7 * true < told < 1.3 * true + MESH, f"dragged by {way}: the indicator is {told}, the force is less by {true}")
