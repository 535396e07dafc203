"""A rubber seal: force, pressure and bulge against order 2 on finer meshes, and the stress beside the contact against its pressure.

LIMIT is from cells of order 2 on 32 x 32 cells with either side nonmortar: 0.226170 and 0.226164, 0.00477872 and 0.00477878. With the flat plate as
nonmortar side its own normal is the direction of contact. Along the normals of the rubber the force was 3.4 % too large. Cells of order 1 without
projection make it 27 % larger again.
"""
from judge import Run, near, require

LIMIT = {"force": 0.226167, "energy": 0.00477875, "crown": 0.7330, "bulge": 0.022049}


def judge(run):
    joint, crown, bulge = run.pair("joint"), run.probe("crown"), run.probe("bulge")
    near("force", joint["normal_force"], LIMIT["force"], relative=5e-4)
    near("potential energy", run.summary["energy"]["potential"], LIMIT["energy"], relative=5e-4)
    near("bulge", bulge["displacement"][0], LIMIT["bulge"], relative=1e-3)
    table = run.table("joint")
    row = table["x"].index(0.0)
    near("pressure at the crown", table["pressure"][row], LIMIT["crown"], relative=1e-3)
    near("stress at the crown", crown["stress"][1], -LIMIT["crown"], relative=5e-3)  # of order 1, as means of cells
    second = run.again("-order", "2", "-rubber_dm_plex_box_faces", "16,16", "-plate_dm_plex_box_faces", "12,3", name="second")
    near("force, order 2", second.pair("joint")["normal_force"], LIMIT["force"], relative=2e-3)
    viewed = run.again("-scene_view", name="view").stdout
    require("body rubber: mean dilatation in each of 2304 cells: at Poisson's ratio 0.4999" in viewed, "-scene_view does not state it")
    require("body plate: mean dilatation" not in viewed, "-scene_view tells of the plate what it does not do")
    iterated(run)


def iterated(run):
    """An iterative solver is warned of, and finds the same where it goes on to the last digits."""
    coarse = ["-rubber_dm_plex_box_faces", "12,12", "-plate_dm_plex_box_faces", "10,3"]
    factored = run.again(*coarse, name="factored").pair("joint")["normal_force"]
    other = Run(run.program, run.mpiexec, run.ranks, run.folder / "iterated", run.arguments + coarse + ["-pc_type", "gamg", "-snes_rtol", "1e-12"])
    require(other.exit == 0, f"exit code {other.exit} with -pc_type gamg")
    require("slow_solver" in [w["code"] for w in other.summary["warnings"]] and "cholesky" in other.stderr, "nobody warns of -pc_type gamg")
    near("force by CG", other.pair("joint")["normal_force"], factored, relative=1e-10)
