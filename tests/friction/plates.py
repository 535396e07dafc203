"""A small rho need not be that of the finest mesh, even if few nodes slip: with its own rho the solve took 253 products."""
from judge import near, require, same

WORK = 215  # products with the matrix of the finest mesh


def judge(run):
    solver = run.summary["solver"]
    same("mesh of rho", solver["friction"]["rho_mesh"], "coarser")
    require(solver["work_units"] <= WORK, f"{solver['work_units']} products")
    dense = run.again("-pc_type", "cholesky", name="dense").summary["solver"]["friction"]
    near("rho", solver["friction"]["rho"], dense["rho"], absolute=0.01)
