"""A mesh with one level: multigrid on levels of some of its nodes finds the solution of a factorization, in tens of iterations. Each rank
chooses its own nodes, so that numbers of iterations, and intermediate sets, differ a little."""
from judge import require
from multigrid import RANKS, iterations_on_ranks

MOST = {"pdas": 40, "vinewtonrsls": 15}  # iterations of CG for all systems of pdas together, for one of vinewtonrsls
GROWTH = 1.3  # times as many for one system on some ranks as on others


def judge(run):
    for snes, most in MOST.items():
        iterations = iterations_on_ranks(run, snes)
        require(max(iterations) <= most, f"{snes} takes {iterations} iterations on {RANKS[snes]} ranks")
        require(snes == "pdas" or max(iterations) <= GROWTH * min(iterations), f"{snes} takes {iterations} iterations for a system on {RANKS[snes]} ranks")
