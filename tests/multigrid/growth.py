"""Iterations do not grow with the mesh: all of a contact solve on the finest level takes as many as one linear system."""
from judge import require

MOST = 10  # iterations of CG for one system to this tolerance, or for all of them together
LEVELS = {2: range(1, 6), 3: range(1, 4)}  # from 1e3 to 1e5 unknowns


def judge(run):
    for levels in LEVELS[run.summary["scene"]["dimension"]]:
        solver = run.again("-pc_type", "truncatedmg", "-dm_refine", str(levels), name=f"levels{levels}").summary["solver"]
        require(solver["linear_iterations"] <= MOST, f"{solver['linear_iterations']} iterations after {levels} refinements")
