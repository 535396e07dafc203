"""Bodies that are moved and not deformed: forces and energy are rounding, and no iteration makes less of them."""
from judge import require

MOST = 5  # without an end at rounding some hundred, until squares of numbers are zero


def judge(run):
    solver = run.summary["solver"]
    require(0 < solver["linear_iterations"] <= MOST, f"{solver['linear_iterations']} iterations")
    require(run.summary["pairs"]["joint"]["active_nodes"] == 0, "contact of bodies that do not meet")
