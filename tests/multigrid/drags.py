"""A factorization replaces an iteration that costs more, unless the user chose the iteration. Bodies that are thin along an axis are
factored at once."""
from judge import Run, near, require, same

LENGTH, WEIGHT, LIFT = 240, 0.001, 0.04  # width and thickness are 1
WITHIN = 1e-5  # of the forces: so soft a strip stores next to no energy
SHORT = f"-a_dm_plex_box_faces 80,1,1 -a_dm_plex_box_upper {LENGTH},1,1 -a_bc_traction_right 0,0,{LIFT}".split()
ACROSS = """-bodies a,b -b_dm_plex_simplex 0 -b_dm_plex_box_faces 1,40,1 -b_dm_plex_box_lower 0,10,5 -b_dm_plex_box_upper 1,130,6 -b_young 3e5
 -b_poisson 0 -b_bc_displacement back -b_bc_displacement_back 0,0,0""".split()  # a second one, in the air: there is no axis along which both are thin


def judge(run):
    solver = run.summary["solver"]
    same("gave way", solver["gave_way"], False)
    require(solver["linear"].startswith("Cholesky"), f"a strip along an axis is solved by {solver['linear']}")

    both = Run(run.program, run.mpiexec, run.ranks, run.folder / "both", run.arguments + SHORT + ACROSS)
    both.require_clean()
    require(both.exit == 0 and "factorizing instead" in both.stderr and "products with the matrix" in both.stderr, f"exit {both.exit}, {both.stderr}")
    solver = both.summary["solver"]
    require(solver["gave_way"] and solver["linear"].startswith("Cholesky"), f"solved by {solver['linear']}")
    near("force", both.summary["pairs"]["under"]["normal_force"], LENGTH * WEIGHT - LIFT, WITHIN)
