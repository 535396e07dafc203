"""Multigrid on levels of some of the nodes, where the mesh has one level, finds what a factorization finds: with both solvers, on any number of
ranks, in tens of iterations. Ranks choose nodes for themselves, so the numbers of iterations for a system differ a little, and sets on the way with them."""
from judge import require
from multigrid import RANKS, iterations_on_ranks

MOST = {"pdas": 40, "vinewtonrsls": 15}  # iterations of CG for all systems of pdas together, for one of vinewtonrsls
GROWTH = 1.3  # times as many for one system on some ranks as on others


def judge(run):
    for snes, most in MOST.items():
        iterations = iterations_on_ranks(run, snes)
        require(max(iterations) <= most, f"{snes} takes {iterations} iterations on {RANKS} ranks")
        require(snes == "pdas" or max(iterations) <= GROWTH * min(iterations), f"{snes} takes {iterations} iterations for a system on {RANKS} ranks")
