"""Several solutions: proximal steps before Newton's steps lead to and fro between them, and the steps alone find one. 16 steps before proximal steps that do not descend
were taken back. With 50 or more also the steps alone cycle (exit code 3 after 74 steps): the coefficient grows."""
from judge import require

MOST = 8  # Newton steps
GROWS = {"50": 20, "1e5": 30}  # Newton steps with such a coefficient


def judge_end(run, most):
    solver = run.summary["solver"]
    require(solver["friction"]["rho"] > 1 and not solver["friction"]["unique"], f"{solver['friction']}")
    require(max(solver["friction"][key] for key in ("cone", "slip", "dissipation")) < 1e-9, f"{solver['friction']}")
    require(solver["iterations"] <= most, f"{solver['iterations']} Newton steps")


def judge(run):
    judge_end(run, MOST)
    for coefficient, most in GROWS.items():
        judge_end(run.again("-floor_friction", coefficient, name=f"grows{coefficient}"), most)
