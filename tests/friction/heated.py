"""A strip that is heated between jaws until all of it slips. By multigrid the end of slip moved by 13 nodes in each step, and the program gave up (exit code 3) after 52."""
from judge import near, require

YOUNG, HALF, LENGTH, STRAIN, FRICTION = 1e6, 0.05, 4, 5e-3, 0.01
PRESSURE = YOUNG * (1e-5 / HALF + STRAIN)
MOST = 12  # Newton steps in one step


def judge(run):
    for solver in ("cholesky", "truncatedmg"):
        done = run.again("-pc_type", solver, name=solver)
        step = done.summary["steps"][1]
        near(f"{solver}: moves", step["probes"]["end"]["displacement"][0], LENGTH * STRAIN - FRICTION * PRESSURE * LENGTH**2 / (2 * YOUNG * HALF), relative=2e-2)
        near(f"{solver}: friction", step["pairs"]["jaw"]["tangential_force"][0], -FRICTION * PRESSURE * LENGTH, relative=2e-2)
        require(max(step["iterations"] for step in done.summary["steps"]) <= MOST, f"{solver}: {[step['iterations'] for step in done.summary['steps']]} Newton steps")
