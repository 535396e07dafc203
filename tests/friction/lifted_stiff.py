"""A stiff block, lifted off a soft one, by multigrid: what is left of the forces is roundoff, and passes for none. It passed for a tension in the contact
of 1.2e-6 (exit code 3)."""
from judge import near


def judge(run):
    pressed, more, lifted = (step["pairs"]["joint"]["normal_force"] for step in run.summary["steps"])
    near("force of the block that is lifted", lifted, 0, absolute=1e-12 * (pressed + more))
