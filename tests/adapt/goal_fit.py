"""Goals in a press fit by temperature: Lame's pressure p, and at the rim the stress 2 p b^2 / (r^2 - b^2) along the circle alone. The dual problem
has no temperature."""
from judge import near, require, same

PRESSURE = 50.5967651980
KNOWN = {"probe:rim": 2 * PRESSURE * 20**2 / (40**2 - 20**2), "pressure:fit": PRESSURE}


def judge(run):
    goals = run.summary["estimate"]["goals"]
    same("goals", [goal["goal"] for goal in goals], list(KNOWN))
    for goal in goals:
        near(goal["goal"], goal["value"], KNOWN[goal["goal"]], absolute=goal["bar"])
        require(goal["met"] and goal["bar"] <= 1e-2 * goal["value"], f"{goal} is not known well enough")
        require(goal["dual_estimate"] < 3e-3 * goal["value"], f"{goal}: the dual estimate has strains without stress in it")
