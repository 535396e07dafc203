"""Truncated multigrid finds the solution of a factorization: with both solvers, on any number of ranks, in the same number of iterations."""
import pathlib
import sys

import numpy as np

from judge import LONG, require, same, same_table

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "same"))
from same import fields  # pylint: disable=wrong-import-position

DISPLACEMENT = 1e-8  # relative to the largest
PRESSURE = 1e-6  # the same; what the certificate of an iterative solver allows forces to be off
SPREAD, MORE = 2, 0.05  # iterations that rounding on other ranks may add, and part of them
RANKS = {"pdas": (1, 2, 3, 4), "vinewtonrsls": (1, 2, 3, 4)} if LONG else {"pdas": (1, 3), "vinewtonrsls": (3,)}


def compare(run, other, what):
    mine, theirs = fields(run), fields(other)
    scale, off = np.abs(mine[:, :3]).max(), np.abs(mine[:, :3] - theirs[:, :3]).max()
    require(off <= DISPLACEMENT * scale, f"displacement with {what}: off by {off:.3g} of {scale:.3g}")
    strongest = np.abs(mine[:, 3:]).max()  # stress: there may be no pressure
    for pair, values in run.summary["pairs"].items():
        same(f"active nodes of {pair} with {what}", other.pair(pair)["active_nodes"], values["active_nodes"])
        same_table(other.table(pair), run.table(pair), {"pressure": (0, PRESSURE * strongest), "status": (0, 0)})


def iterations_on_ranks(run, snes):
    """Compares the solutions on all numbers of ranks; iterations of pdas in all, of vinewtonrsls for a system."""
    iterations = []
    for ranks in RANKS[snes]:
        other = run.again("-pc_type", "truncatedmg", "-snes_type", snes, ranks=ranks, name=f"{snes}{ranks}")
        compare(run, other, f"{snes} on {ranks} ranks")
        solver = other.summary["solver"]
        # rounding may decide whether vinewtonrsls takes one step more; what counts is a system's price
        iterations.append(solver["linear_iterations"] / (solver["iterations"] if snes == "vinewtonrsls" else 1))
    return iterations


def judge(run):
    for snes, ranks in RANKS.items() if LONG else [("pdas", RANKS["pdas"])]:  # else opinion.py and nodes.py have vinewtonrsls
        iterations = iterations_on_ranks(run, snes)
        require(max(iterations) - min(iterations) <= SPREAD + MORE * min(iterations), f"{snes} takes {iterations} iterations on {ranks} ranks")
