"""Cells that are long along one axis cost no more iterations than cubes, on any number of ranks. Planes of nodes are smoothed as one block,
across ranks, too. The set of the coarser level has some ten nodes too many: cycles ahead of the first system find the last one."""
from judge import LONG, require

MOST = 12  # iterations of CG for all active sets together; 50 with lines in place of planes
RANKS = (1, 2, 4, 8) if LONG else (1, 3)


def judge(run):
    solvers = [run.again(ranks=ranks, name=f"ranks{ranks}").summary["solver"] for ranks in RANKS]
    counts = [solver["linear_iterations"] for solver in solvers]
    sets = [solver["iterations"] for solver in solvers]
    require(max(sets) == 1, f"{sets} sets on {RANKS} ranks")
    require(max(counts) <= MOST, f"{counts} iterations on {RANKS} ranks")
    require(max(counts) - min(counts) <= 1, f"{counts} iterations on {RANKS} ranks")
