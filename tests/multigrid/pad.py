"""A body that next to nothing resists: what springs still pull is little beside the forces, and yet it must not move the body."""
from judge import require

NEAR = 1e-9  # 3e-8 where the first sweep is the last


def judge(run):
    check = run.summary["solver"]["cross_check"]
    require(check["agree"] and check["displacement_difference"] <= NEAR, str(check))
