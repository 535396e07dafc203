"""What friction costs by multigrid: products of the iteration and of rho, which is within some per cent of that of the dense system."""
from judge import near, require

WORK = 370  # products with the matrix of the finest mesh


def judge(run):
    solver = run.summary["solver"]
    require(solver["work_units"] <= WORK, f"{solver['work_units']} products")
    dense = run.again("-pc_type", "cholesky", name="dense")
    near("rho", solver["friction"]["rho"], dense.summary["solver"]["friction"]["rho"], relative=0.03)
