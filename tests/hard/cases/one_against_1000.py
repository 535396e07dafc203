"""Weight and lever arm."""
from judge import near


def judge(run):
    turned = ["-joint_nonmortar", "lower:top", "-joint_mortar", "upper:bottom"]
    for solved, sign in ((run, 1), (run.again(*turned, name="fine"), -1), (run.again("-upper_order", "2", name="quadratic"), 1)):
        near("force", solved.pair("joint")["force"], [0, 1.5 * sign], absolute=1e-9)
        near("place", solved.pair("joint")["centre_of_pressure"][0], 5 / 9, absolute=1e-8)
