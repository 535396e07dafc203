"""CG with an algebraic multigrid in place of the factorization: the rigid motions of every body reach the preconditioner."""
import os

from judge import near, require, same

ITERATIONS = {"gamg": 60, "hypre": 60}  # per linear solve to the final tolerance: more means lost near null space


def judge(run):
    for pc, most in ITERATIONS.items():
        if pc == os.environ.get("MORTISE_TEST_WITHOUT"):
            continue
        for ranks in (1, 2):
            again = run.again("-ksp_type", "cg", "-pc_type", pc, ranks=ranks, name=f"{pc}{ranks}")
            solver = again.summary["solver"]
            same(f"history with {pc}", solver["changed"], run.summary["solver"]["changed"])
            near(f"force with {pc}", again.pair("joint")["normal_force"], run.pair("joint")["normal_force"], relative=1e-8)
            each = solver["linear_iterations"] / solver["iterations"]
            require(each <= most, f"{pc} takes {each:.0f} iterations for a linear system")
