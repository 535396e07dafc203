"""A uniform state passes."""
from judge import near
from uniform import judge_uniform


def judge(run):
    judge_uniform(run, ["joint"], accuracy=1e-7)
    near("potential", run.summary["energy"]["potential"], -0.5 * (1e-3 + 1e-9), relative=1e-9)
