"""Reactions of sides with few meshes of order 1: those of order 2 lie within their bars, also small ones of a stiff body that is hardly refined."""
from judge import require


def judge(run):
    coarse = run.summary
    fine = run.again("-order", "2", "-adapt", "0.05", name="fine").summary
    for side, bars in coarse["bars"]["reactions"].items():
        largest = max(abs(x) for other, values in coarse["reactions"].items() if other.split(":")[0] == side.split(":")[0] for x in values)
        for k, bar in enumerate(bars):
            found, known, own = coarse["reactions"][side][k], fine["reactions"][side][k], fine["bars"]["reactions"][side][k]
            require(abs(found - known) <= bar + own, f"{side}[{k}]: {found} +- {bar}, finer {known} +- {own}")
            require(bar < 0.2 * largest and own < 0.05 * largest, f"{side}[{k}]: bars {bar}, {own} of reactions up to {largest} say nothing")
