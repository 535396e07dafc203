"""Cells that are long along one axis cost no more iterations than cubes, on any number of ranks. Planes of nodes are smoothed as one block,
across ranks, too."""
from judge import LONG, require

MOST = 15  # iterations of CG for all active sets together; 50 with lines in place of planes
RANKS = (1, 2, 4, 8) if LONG else (1, 3)


def judge(run):
    counts = [run.again(ranks=ranks, name=f"ranks{ranks}").summary["solver"]["linear_iterations"] for ranks in RANKS]
    require(max(counts) <= MOST, f"{counts} iterations on {RANKS} ranks")
    require(max(counts) - min(counts) <= 1, f"{counts} iterations on {RANKS} ranks")
