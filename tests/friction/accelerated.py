"""The second solver with a large coefficient, which the plain fixed point iteration does not solve in 500 steps: it agrees with the first one."""
from judge import require


def judge(run):
    solver = run.summary["solver"]
    check = solver["cross_check"]
    require(0.9 < solver["friction"]["rho"] < 1 and solver["friction"]["unique"], f"{solver['friction']}")
    require(check["converged"] and check["agree"] and check["displacement_difference"] < 1e-9, f"{check}")
    require(check["iterations"] <= 300, f"{check['iterations']} steps")
