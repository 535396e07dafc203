"""The first set of a body that contact alone holds, on a mesh with one level. Cycles ahead of the first system find it, up to what one system
corrects: they go through few sets, although the first of them is far too large."""
from judge import require

SETS, ITERATIONS, WORK = 2, 26, 305  # three sets, 28 iterations and 311 units while each set lost what pulls alone
RANGE = 2


def judge(run):
    counts = []
    for ranks in (1, 3):
        solver = run.again(ranks=ranks, name=f"ranks{ranks}").summary["solver"]
        require(solver["certified"], f"not certified on {ranks} ranks")
        require(solver["iterations"] <= SETS, f"{solver['iterations']} sets on {ranks} ranks")
        counts.append(solver["linear_iterations"])
        if ranks == 1:
            require(solver["linear_iterations"] <= ITERATIONS, f"{solver['linear_iterations']} iterations")
            require(solver["work_units"] <= WORK, f"{solver['work_units']} work units")
    require(max(counts) - min(counts) <= RANGE, f"{counts} iterations on one and three ranks")
