"""Blocks that nearly tip: contact opens by fewer and fewer nodes, while the residual rises. By multigrid the coefficient then grew from 1, in 25 Newton steps; the dense system takes 7."""
from judge import near, require

MOST = 12  # Newton steps
PUSH, WEIGHTS = 0.3714, [1.72419, 0.8621]


def judge(run):
    near("friction of the floor", run.pair("floor")["tangential_force"], [-PUSH, 0], absolute=1e-7)
    near("normal forces", [run.pair(name)["normal_force"] for name in ("floor", "joint")], WEIGHTS, relative=1e-7)
    for solver in ("cholesky", "truncatedmg"):
        steps = run.again("-pc_type", solver, name=solver).summary["solver"]["iterations"]
        require(steps <= MOST, f"{solver}: {steps} Newton steps")
