"""A node with parts of its facets on either table serves the first; the second hands its part on."""
from judge import near

def judge_uniform(run, pairs, pressure=1, accuracy=1e-10):
    for name in pairs:
        table = run.table(name)
        found = [p for p, status in zip(table["pressure"], table["status"]) if status != -1]
        near(f"pressure of {name}", found, [pressure] * len(found), relative=accuracy)


def judge(run):
    for order in "12":
        solved = run.again("-order", order, name=f"order{order}")
        judge_uniform(solved, ["first", "second"])
        near("forces", [solved.pair(name)["normal_force"] for name in ("first", "second")], [0.45, 0.55], relative=1e-10)
