"""Slip in space by multigrid. The resistance to turning is in the cycle, and systems take two or three iterations each, whatever part of the contact
slips."""
from judge import require

ITERATIONS = 16  # of the second step: 12; 25 where the cycle does not know it


def judge(run):
    step = run.summary["steps"][1]
    require(run.summary["solver"]["linear"] == "gmres with truncatedmg", run.summary["solver"]["linear"])
    require(run.summary["solver"]["friction"]["slipping"] > 0, "nothing slips")
    require(step["linear_iterations"] <= ITERATIONS, f"{step['linear_iterations']} iterations of GMRES")
