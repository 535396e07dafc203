"""Coarser levels are there to begin with: where their sets go to and fro they must not take many times what the finest level does."""
from judge import require

MOST = 600  # products in all; the finest level's systems take some 200


def judge(run):
    work = run.summary["solver"]["work_units"]
    require(work <= MOST, f"{work:.0f} work units")
