"""Stress is that of the sheet, forces and energy are for its thickness."""
from judge import near
from uniform import judge_uniform


def judge(run):
    for solved in (run, run.again("-order", "2", name="quadratic")):
        judge_uniform(solved, ["joint"])
        near("force", solved.pair("joint")["force"], [0, 1e-6], absolute=1e-16)
        near("potential", solved.summary["energy"]["potential"], -0.5e-6 * (1e-3 + 1e-6), relative=1e-10)
