"""A nearly incompressible block: from the coarser mesh the second step leaves a residual above the forces, and the next ones descend. 14 steps where the iteration went on from the
solution without friction there, too."""
from judge import require

MOST = 10  # Newton steps


def judge(run):
    require(run.summary["solver"]["iterations"] <= MOST, f"{run.summary['solver']['iterations']} Newton steps")
