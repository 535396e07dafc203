"""A uniform state passes."""
from judge import near

def judge_uniform(run, pairs, pressure=1, accuracy=1e-10):
    for name in pairs:
        table = run.table(name)
        found = [p for p, status in zip(table["pressure"], table["status"]) if status != -1]
        near(f"pressure of {name}", found, [pressure] * len(found), relative=accuracy)


def judge(run):
    judge_uniform(run, ["joint"], accuracy=1e-7)
    near("potential", run.summary["energy"]["potential"], -0.5 * (1e-3 + 1e-9), relative=1e-9)
