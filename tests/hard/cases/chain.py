"""A pressure passes through five blocks unchanged."""
from judge import near, same


def judge_row(run):
    for name in run.summary["pairs"]:
        table = run.table(name)
        near(f"pressure of {name}", table["pressure"], [1] * len(table["pressure"]), absolute=1e-9)
    near("potential", run.summary["energy"]["potential"], -0.91 * (3 / 2000 + 2 / 2e6), relative=1e-10)
    same("free motions", len(run.summary["solvability"]["free_motions"]), 5)


def judge(run):
    judge_row(run)
    judge_row(run.again("-order", "2", name="quadratic"))
