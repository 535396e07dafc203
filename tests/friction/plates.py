"""A small rho need not be that of the finest mesh, even if few nodes slip: with its own rho the solve took 253 products, with a twentieth of rho as its error on the coarser mesh 200."""
from judge import require, same

WORK = 165  # products with the matrix of the finest mesh


def judge(run):
    solver = run.summary["solver"]
    same("mesh of rho", solver["friction"]["rho_mesh"], "coarser")
    require(solver["work_units"] <= WORK, f"{solver['work_units']} products")
    dense = run.again("-pc_type", "cholesky", name="dense").summary["solver"]["friction"]
    off = abs(solver["friction"]["rho"] - dense["rho"])
    require(off <= solver["friction"]["rho_error"] + dense["rho_error"] < 0.02, f"rho {solver['friction']} and {dense}")
