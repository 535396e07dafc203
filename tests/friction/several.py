"""Several solutions: sweeps before Newton's steps lead to and fro between them, and the steps alone find one."""
from judge import require


def judge(run):
    solver = run.summary["solver"]
    require(solver["friction"]["rho"] > 1 and not solver["friction"]["unique"], f"{solver['friction']}")
    require(max(solver["friction"][key] for key in ("cone", "slip", "dissipation")) < 1e-9, f"{solver['friction']}")
