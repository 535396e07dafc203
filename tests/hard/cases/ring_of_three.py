"""A pressure around three rhombi is the pressure of all their joints; the weakest reason yields."""
from judge import near, same


def judge_ring(run, roles):
    for name in run.summary["pairs"]:
        table = run.table(name)
        near(f"pressure of {name}", table["pressure"], [1] * len(table["pressure"]), absolute=1e-8)  # springs leave 6e-10
    found = {name: pair["nonmortar"].split(":")[0] for name, pair in run.summary["scene"]["pairs"].items()}
    same("nonmortar bodies", found, roles)


def judge(run):
    roles = {"ab": "b", "bc": "b", "ca": "c"}  # facets 1.5, 3.5 and 1.7 times as fine
    judge_ring(run, roles)
    judge_ring(run.again("-order", "2", name="quadratic"), roles)
    judge_ring(run.again("-b_young", "4000", name="stiffer"), {"ab": "a", "bc": "b", "ca": "a"})  # a is softer by far
