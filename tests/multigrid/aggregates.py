"""Multigrid on levels of aggregates, where the mesh has one level, finds what a factorisation finds: with both solvers, on any number of
ranks, in tens of iterations. Ranks aggregate for themselves, so the numbers of iterations differ a little."""
from judge import require
from multigrid import RANKS, iterations_on_ranks

MOST = 35  # iterations of CG for one system of vinewtonrsls, and twice as many for all of pdas together
GROWTH = 1.3  # times as many on some ranks as on others


def judge(run):
    for snes, most in (("pdas", 2 * MOST), ("vinewtonrsls", MOST)):
        iterations = iterations_on_ranks(run, snes)
        require(max(iterations) <= min(most, GROWTH * min(iterations)), f"{snes} takes {iterations} iterations on {RANKS} ranks")
