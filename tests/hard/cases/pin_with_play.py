"""The load of a polygon of 24 corners, and what is in contact."""
import math

from judge import near, require, same

AREA = 24 / 2 * 10**2 * math.sin(2 * math.pi / 24)
PRESSES = 1e-6  # of the largest pressure: far above what solvers leave, far below what the outermost node has


def judge(run):
    pair, table = run.pair("joint"), run.table("joint")
    near("force on the plate", pair["force"], [30 * AREA, 0], absolute=1e-9 * 30 * AREA)
    pressing = [p > PRESSES * pair["max_pressure"] for p in table["pressure"]]
    same("nodes in contact", [status == 1 for status in table["status"]], pressing)
    same("number of nodes in contact", pair["active_nodes"], sum(pressing))
    near("energy of the solver's error", run.summary["solver"]["energy_bound"]["relative"], 0, absolute=1e-8)
    require(run.summary["solver"]["energy_bound"]["absolute"] > 0, "a bound of exactly nothing")
