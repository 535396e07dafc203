"""A shaft pressed 1e-5 of its radius into a block, whose first cells are 2800 times as wide as half the contact, by multigrid on all meshes. Hertz' largest
pressure for the force that is found."""
import math

from judge import near, require

MODULUS = 1000 / (1 - 0.3**2)


def judge(run):
    goals = {goal["goal"]: goal for goal in run.summary["estimate"]["goals"]}
    require(all(goal["met"] for goal in goals.values()), f"{goals}")
    force, pressure = goals["force:joint"], goals["pressure:joint"]
    half_width = math.sqrt(8 * force["value"] / (math.pi * MODULUS))
    near("largest pressure", pressure["value"], 4 * force["value"] / (math.pi * half_width), absolute=pressure["bar"] + force["bar"] * pressure["value"] / force["value"])
