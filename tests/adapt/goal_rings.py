"""Goals in a press fit of two rings: Lame's pressure, its sum, and von Mises' stress at the bore. The stress there is -8/3 p along the circle and nu
times that across."""
import math

from judge import near, require, same

PRESSURE = 0.192374956  # interference 0.001
KNOWN = {"pressure:fit": PRESSURE, "force:fit": math.pi * PRESSURE, "probe:bore": 8 / 3 * PRESSURE * math.sqrt(1 - 0.25 + 0.25**2)}


def judge(run):
    goals = run.summary["estimate"]["goals"]
    same("goals", [goal["goal"] for goal in goals], list(KNOWN))
    for goal in goals:
        near(goal["goal"], goal["value"], KNOWN[goal["goal"]], absolute=goal["bar"])
        require(goal["met"] and goal["bar"] <= 0.01 * goal["value"], f"{goal} is not known well enough")
