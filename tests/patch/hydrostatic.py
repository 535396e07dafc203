"""Uniform pressure from all sides: p = 1e6 at every multiplier, sigma = -1e6 I in the plane at every node."""
from judge import near, require

PRESSURE = 1e6
# Relative. A pressure is a force over the weight of its node, which on quadratic facets is a sixth of one, not a half: rounding
# of the forces, whose stiffness is larger besides, shows some five times more (1.2e-12 measured).
ROUNDOFF = {1: 1e-12, 2: 1e-11}


def hydrostatic(run, tolerance=1e-12):
    for pair in run.summary["pairs"]:
        table = run.table(pair)
        pressed = [p for p, status in zip(table["pressure"], table["status"]) if status != -1]
        require(pressed, f"{pair}: there are no multipliers")
        near(f"pressure of {pair}", pressed, [PRESSURE] * len(pressed), relative=tolerance)
    with run.fields() as file:
        stress = file["stress"][()]
    for component, name in ((0, "xx"), (4, "yy")):
        near("sigma_" + name, stress[:, component], [-PRESSURE] * len(stress), relative=tolerance)


def judge(run):
    hydrostatic(run, ROUNDOFF[2 if any(word.endswith("order") for word in run.arguments) else 1])
