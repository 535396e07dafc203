"""A gap along the normal of a curved side, whose formula names x alone: the contact of the rigid plane that it gives. Its slope alone for the obstacle's
normal had the pressures act along the side, with four times the force."""
from judge import near


def judge(run):
    plane = ["-joint_obstacle", "plane", "-joint_obstacle_point", "0,1.046", "-joint_obstacle_normal", "0,-1", "-options_allow_unused"]
    other = run.again(*plane, name="plane", warns=["unused_option"])
    for key in ("normal_force", "area", "max_pressure"):
        near(key, run.pair("joint")[key], other.pair("joint")[key], relative=1e-3)
    near("force along the plane", run.pair("joint")["force"][0], 0, absolute=1e-6 * run.pair("joint")["normal_force"])
