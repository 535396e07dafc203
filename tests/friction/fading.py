"""A coefficient that names t, and no other datum: a block stays on its incline until the coefficient is below the slope, 0.2. More of it slips in each step."""
from judge import Run, near, require, same


def judge(run):
    steps = run.summary["steps"]
    for step in steps:
        near(f"friction at t = {step['t']}", step["pairs"]["floor"]["tangential_force"], [-4e3, 0], relative=1e-11)
    shares = [step["pairs"]["floor"]["slip_share"] for step in steps]
    require(shares[0] < shares[1] < 1, f"shares that slip: {shares}")
    slides = Run(run.program, run.mpiexec, run.ranks, run.folder / "slides", [*run.arguments, "-load_steps", "1,3"])
    same("exit code at a coefficient of 0.15", slides.exit, 2)
    require("there is no solution at t = 3; the last solution is that of t = 1" in slides.stderr, slides.stderr)
