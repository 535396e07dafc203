"""Nearly incompressible cells of order 1 in the plane: waves of alternating sign as a second coarse space, between meshes that do not match. Iterations
do not depend on the number of ranks."""
from judge import require

MOST = 20  # 24 on the finer mesh with five steps for seven; without waves 47, and 61 on the finer mesh


def iterations(run):
    return run.summary["solver"]["linear_reference"]["iterations"]


def judge(run):
    counts = [iterations(run.again("-measure_linear", "1", ranks=ranks, name=f"ranks{ranks}")) for ranks in (1, 2, 3)]
    finer = iterations(run.again("-measure_linear", "1", "-dm_refine", "3", name="finer"))
    require(max(counts + [finer]) <= MOST, f"{counts} iterations, {finer} on a finer mesh")
    require(max(counts) - min(counts) <= 1, f"{counts} iterations on 1, 2 and 3 ranks")
