"""A strip that is drawn out of jaws and let go: slip spreads from its end, then turns back from there. Where it slipped without turning back, tractions stay exactly at their limit
without slip, and Newton's steps would pass that state node by node: 101 and 86 steps before slip that turns back within a step was clipped. By multigrid 14, 6 and 10 while
proximal steps ended after 24, and while slips of roundoff gave the direction of friction."""
from judge import near, require

FRICTION, STIFFNESS, PULL = 0.2 * 200, 1e6 * 0.05, 2240 * 0.05
TURNS = 7  # the same, where the pull turns: 8 and 14 with a guess that goes on as before
MOST = {"cholesky": 10, "truncatedmg": 10}  # Newton steps in one step, with those of the proximal point iteration


def judge(run):
    moved = PULL**2 / (2 * FRICTION * STIFFNESS)
    for solver, most in MOST.items():
        done = run.again("-pc_type", solver, name=solver)
        steps = done.summary["steps"][1:]
        near("moves", [step["probes"]["end"]["displacement"][0] for step in steps], [moved, moved * 7 / 8, moved / 2], relative=1e-2)
        near("friction", [step["pairs"]["jaw"]["tangential_force"][0] for step in steps], [-PULL, -PULL / 2, 0], absolute=1e-7 * PULL)
        require(steps[1]["iterations"] <= TURNS, f"{solver}: {steps[1]['iterations']} Newton steps where the pull turns")
        require(max(step["iterations"] for step in steps) <= most, f"{solver}: {[step['iterations'] for step in steps]} Newton steps")
