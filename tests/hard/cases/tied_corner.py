"""One state in all three."""
from judge import near

def judge_uniform(run, pairs, pressure=1, accuracy=1e-10):
    for name in pairs:
        table = run.table(name)
        found = [p for p, status in zip(table["pressure"], table["status"]) if status != -1]
        near(f"pressure of {name}", found, [pressure] * len(found), relative=accuracy)


def judge(run):
    for order in "12":
        judge_uniform(run.again("-order", order, name=f"order{order}"), ["foot", "joint"])
