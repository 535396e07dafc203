"""Two plates of 67 588 unknowns: multigrid is the default, in half of the time of a factorization."""
from judge import require


def judge(run):
    linear = run.summary["solver"]["linear"]
    require(linear == "cg with truncatedmg", f"solved by {linear}")
