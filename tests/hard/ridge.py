"""A ridge touches a smooth side along the normal of that side. Where one flank of the ridge decided, it was chosen by roundoff: the force was (-1.5, 3.0)."""
from judge import near


def judge(run):
    force = run.pair("joint")["force"]
    near("force across", force[0], 0, absolute=1e-9 * force[1])
    other = run.again("-joint_nonmortar", "roof:top", "-joint_mortar", "block:bottom", name="exchanged").pair("joint")["force"]
    near("force, sides exchanged", -other[1], force[1], relative=0.1)
