import math

from judge import near


def judge(run):
    table, force = run.table("punch"), run.pair("punch")["normal_force"]
    for x, p in zip(table["x"], table["pressure"]):
        if abs(x) < 0.9:
            near(f"pressure at {x:.4g}", p, force / math.pi / math.sqrt(1 - x * x), relative=1.5e-2)
