"""A parabola pressed into a block in load steps on adaptive meshes. Forces and half widths of an independent high-order solution lie within
the bars of each step. Later steps have more meshes than the first where they need them."""
from judge import near, require, same

# t: force, half width (options/parabola.opts)
REFERENCE = {0.125: (1.939570, 0.047394), 0.25: (4.254231, 0.070172), 0.5: (9.431822, 0.104425), 1: (21.197056, 0.156349)}


def judge(run):
    steps = run.summary["steps"]
    same("times", [step["t"] for step in steps], list(REFERENCE))
    for step, (force, width) in zip(steps, REFERENCE.values()):
        pair, bars = step["pairs"]["joint"], step["bars"]["pairs"]["joint"]
        near(f"force at t = {step['t']}", pair["normal_force"], force, absolute=bars["normal_force"])
        near(f"half width at t = {step['t']}", pair["area"] / 2, width, absolute=bars["area"] / 2)
        require(bars["normal_force"] < 1e-3 * force, f"the bar at t = {step['t']} is {bars['normal_force']}")
        require(step["estimate"]["energy_norm_relative"] <= 3.5e-3, f"{step['estimate']}")
    unknowns = [step["estimate"]["meshes"][-1]["unknowns"] for step in steps]
    require(unknowns == sorted(unknowns) and unknowns[-1] > unknowns[0], f"unknowns of the steps: {unknowns}")
