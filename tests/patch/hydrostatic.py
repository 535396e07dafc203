"""Uniform pressure from all sides: p = 1e6 at every multiplier, sigma = -1e6 I in the plane at every node."""
from judge import near, same

PRESSURE = 1e6


def judge(run):
    for pair in run.summary["pairs"]:
        table = run.table(pair)
        pressed = [p for p, status in zip(table["pressure"], table["status"]) if status != -1]
        near(f"pressure of {pair}", pressed, [PRESSURE] * len(pressed), relative=1e-12)
    with run.fields() as file:
        stress = file["stress"][()]
    for component, name in ((0, "xx"), (4, "yy")):
        near("sigma_" + name, stress[:, component], [-PRESSURE] * len(stress), relative=1e-12)
    same("bodies", len(run.summary["scene"]["bodies"]), 3)
