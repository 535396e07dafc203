"""Rigid obstacles: one number for each pair, bounded under refinement."""
from judge import near, require


def judge(run):
    fine = run.again("-dm_refine", "1", name="fine")
    for name, pair in run.summary["pairs"].items():
        beta, finer = pair["inf_sup"]["number"], fine.pair(name)["inf_sup"]["number"]
        require(min(beta, finer) > 0.9, f"{name}: {beta}, {finer}")
        near(f"{name}, refined", finer, beta, relative=0.05)
