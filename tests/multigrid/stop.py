"""-stop discretisation ends at a tenth of the discretisation error, says how large both are, and takes a third of the work."""
from math import sqrt

from judge import LONG, near, require

LIMIT = -5918.26337  # potential energy under refinement, from an independent high-order solution (options/two_plates.opts)
WORK = 60            # products with the finest matrix, all levels


def judge_order(run):
    """Corners of the supports keep order 2 from converging as it could: three levels show how it does, and two are on the safe side."""
    for name, cells, refine, low, high in (("three", "16", "2", 0.9, 1.1), ("two", "8", "1", 1, 1.6)):
        mesh = ("-order", "2", "-upper_dm_plex_box_faces", f"{cells},{cells}", "-lower_dm_plex_box_faces", f"{cells},{cells}", "-dm_refine", refine)
        estimate = run.again(*mesh, name=name).summary["solver"]["discretisation_error"]["absolute"]
        error = sqrt(2 * (run.again(*mesh, "-stop", "residual", name=f"{name}_whole").summary["energy"]["potential"] - LIMIT))
        require(low * error <= estimate <= high * error, f"{name} levels: estimate {estimate} of an error of {error}")


def judge(run):
    whole = run.again("-stop", "residual", name="whole").summary
    part = run.summary
    solver, energy, exact = part["solver"], part["energy"]["potential"], whole["energy"]["potential"]
    require(whole["solver"]["discretisation_error"] is None, "an error of the mesh that nobody asked for")
    estimate, bound = solver["discretisation_error"]["absolute"], solver["energy_bound"]["absolute"]
    require(bound <= estimate / 10, f"the solver's error {bound} by that of the mesh {estimate}")
    # of a feasible displacement, 1/2 |u - u_h|_K^2 is at most what its energy is above the least one
    require(energy >= exact - 1e-9 * abs(exact), f"energy {energy} below the least, {exact}")
    require(sqrt(2 * max(energy - exact, 0)) <= 1.2 * bound, f"the error {sqrt(2 * (energy - exact))} above its bound {bound}")
    near("discretisation error", estimate, sqrt(2 * (exact - LIMIT)), relative=0.1)
    near("force", part["pairs"]["joint"]["force"][1], whole["pairs"]["joint"]["force"][1], relative=1e-3)
    require(solver["work_units"] <= WORK, f"{solver['work_units']} units of work")
    require(solver["work_units"] < 0.5 * whole["solver"]["work_units"], "no less work than to the end")
    require("of the solution, in the energy norm, estimated from coarser meshes\n" in run.stdout, run.stdout)
    if run.ranks == 1 or LONG:
        judge_order(run)
    coarse = run.again("-upper_dm_plex_box_faces", "2,2", "-lower_dm_plex_box_faces", "2,2", "-dm_refine", "1", name="coarse", warns=["coarse_contact", "coarse_mesh"])
    require(coarse.summary["solver"]["discretisation_error"]["relative"] > 0.1, "a mesh of four cells along a side is not coarse")
