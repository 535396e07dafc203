"""Weights in a shaft: every pressure is the weight above per area, the chain's as well."""
from judge import near


def judge(run):
    for pair, weight in (("upper", 2e4), ("lower", 5e4)):
        near(f"force of {pair}", run.pair(pair)["force"], [0, 0, weight], relative=1e-11)
        for pressure in run.table(pair)["pressure"]:
            near(f"pressure of {pair}", pressure, weight, relative=1e-9)
