"""Near rounding residuals do not tell steps from each other, and the second solver goes whole ones: both find the same digits."""
from judge import require

NEAR = 1e-12  # 4e-10 where a line search chooses among residuals that are rounding


def judge(run):
    check = run.summary["solver"]["cross_check"]
    require(check["agree"] and check["displacement_difference"] <= NEAR, str(check))
    force = run.summary["pairs"]["below"]["force"][1]
    require(abs(abs(force) - 20) <= 1e-6 * 20, f"force {force} for 20")  # 10 on a side of length 2
    steered = run.again("-cross_check_snes_linesearch_type", "basic", name="steered").summary["solver"]["cross_check"]
    require(steered["agree"], f"whole steps: {steered}")
