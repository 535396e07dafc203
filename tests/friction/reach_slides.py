"""History outlives a step for which pairs are made anew: with a reach that is wide from the start nothing is."""
from judge import near


def judge(run):
    wide = run.again("-joint_reach", "0.5", name="wide")
    for step, other in zip(run.summary["steps"][1:], wide.summary["steps"][1:]):
        pair, same = step["pairs"]["joint"], other["pairs"]["joint"]
        # Before it touches, the column moves 7e4 times as far as it then slips.
        # On three ranks, roundoff was 1e-7 of the slip and 2.5e-9 of the force.
        near(f"friction at t = {step['t']}", pair["tangential_force"], same["tangential_force"], absolute=1e-8 * same["normal_force"])
        near(f"slip at t = {step['t']}", pair["max_slip"], same["max_slip"], relative=1e-6)
        near(f"dissipation at t = {step['t']}", pair["dissipation"], same["dissipation"], relative=1e-6)
