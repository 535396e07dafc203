"""Blocks that only contact holds: every pair has a number, the same on any number of ranks; there is no condition number."""
from judge import near, require, same


def judge(run):
    same("condition numbers", [p["inf_sup"]["condition"] for p in run.summary["pairs"].values()], [None] * 5)
    betas = [p["inf_sup"]["number"] for p in run.summary["pairs"].values()]
    require(all(0.5 < beta < 1.2 for beta in betas), f"numbers {betas}")
    alone = run.again(ranks=1)
    near("on one rank", betas, [p["inf_sup"]["number"] for p in alone.summary["pairs"].values()], relative=1e-6)
