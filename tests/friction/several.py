"""Several solutions: proximal steps before Newton's steps lead to and fro between them, and the steps alone find one. 16 steps before proximal steps that do not descend
were taken back."""
from judge import require

MOST = 8  # Newton steps


def judge(run):
    solver = run.summary["solver"]
    require(solver["friction"]["rho"] > 1 and not solver["friction"]["unique"], f"{solver['friction']}")
    require(max(solver["friction"][key] for key in ("cone", "slip", "dissipation")) < 1e-9, f"{solver['friction']}")
    require(solver["iterations"] <= MOST, f"{solver['iterations']} Newton steps")
