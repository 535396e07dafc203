"""Steps that end where slip of a node ends: the node sticks next. By multigrid it slipped on, and steps of the same decisions were shortened to nothing: exit code 3 after 136 steps.
They stall at 0.3 % of the forces, with a coefficient above 1: then it grows, and the dense system does not take the place of multigrid."""
from judge import near, require

MOST = {"cholesky": 12, "truncatedmg": 15}  # Newton steps
PUSH, WEIGHTS = 0.483713, [2.336801, 1.199191]


def judge(run):
    for solver, most in MOST.items():
        done = run.again("-pc_type", solver, name=solver)
        near(f"{solver}: friction", [done.pair(name)["tangential_force"][0] for name in ("floor", "joint")], [-PUSH, -PUSH], absolute=1e-6)
        near(f"{solver}: normal forces", [done.pair(name)["normal_force"] for name in ("floor", "joint")], WEIGHTS, relative=1e-6)
        require(done.summary["solver"]["iterations"] <= most, f"{solver}: {done.summary['solver']['iterations']} Newton steps")
        require(not done.summary["solver"]["gave_way"], f"{solver}: replaced")
