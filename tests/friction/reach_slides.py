"""History outlives a step for which pairs are made anew: with a reach that is wide from the start nothing is."""
from judge import near


def judge(run):
    wide = run.again("-joint_reach", "0.5", name="wide")
    for step, other in zip(run.summary["steps"][1:], wide.summary["steps"][1:]):
        pair, same = step["pairs"]["joint"], other["pairs"]["joint"]
        near(f"friction at t = {step['t']}", pair["tangential_force"], same["tangential_force"], absolute=1e-9 * same["normal_force"])
        near(f"slip at t = {step['t']}", pair["max_slip"], same["max_slip"], relative=1e-8)
        near(f"dissipation at t = {step['t']}", pair["dissipation"], same["dissipation"], relative=1e-8)
