from bars import bar
from judge import near


def judge(run):
    options, table = run.summary["options"], run.table("joint")
    upper, lower = bar(options, "upper"), bar(options, "lower")
    pressure = (5000 / upper[0] / 2 - (upper[1] - lower[2])) / (1 / upper[0] + 1 / lower[0])
    near("pressure", table["pressure"], [pressure] * len(table["x"]), relative=1e-10)
