"""Weights."""
from judge import near, same


def judge(run):
    for k in range(10):
        near(f"force {k}", run.pair(f"p{k}")["force"], [0, k + 1], absolute=1e-9)
        near(f"place of force {k}", run.pair(f"p{k}")["centre_of_pressure"], [k + 0.5, 0], absolute=1e-9)
    same("free motions", len(run.summary["solvability"]["free_motions"]), 10)
