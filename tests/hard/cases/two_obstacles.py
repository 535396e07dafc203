"""Symmetry; and one obstacle that is both."""
from judge import Run, near, same


def judge(run):
    left, right = run.pair("left"), run.pair("right")
    near("force on the right", right["normal_force"], left["normal_force"], relative=1e-9)
    both = Run(run.program, run.mpiexec, run.ranks, run.folder / "one",
               run.arguments + ["-pairs", "one", "-one_nonmortar", "block:top", "-one_obstacle", "expression", "-one_obstacle_gap", "0.9-sqrt(1-(abs(x)-0.5)^2)", "-options_allow_unused"])
    same("exit code", both.exit, 0)
    near("force of both", left["normal_force"] + right["normal_force"], both.pair("one")["normal_force"], relative=1e-9)
