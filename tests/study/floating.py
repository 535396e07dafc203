"""A body held by contact only: every run starts with all nodes in contact, whatever the coarser one found.

Force: equilibrium. Potential: an independent high-order solution, -0.0045621367(1)."""
from judge import near
from studies import inside, rows


def judge(run):
    for row in rows(run):
        near("force", row["joint_normal_force"], 3, relative=1e-9)
    inside(run, "potential", -0.0045621367)
