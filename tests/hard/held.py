"""Bodies that only contact holds: who solves and on how many ranks makes no difference, down to the position of what is free to slide."""
import numpy as np

from judge import near, require, Run, same

SOLVERS = [["-snes_type", "vinewtonrsls"], ["-ksp_type", "cg", "-ksp_rtol", "1e-12"], ["-snes_pdas_reduce", "0"], ["-snes_pdas_start", "gap"],
           ["-snes_pdas_start", "empty"]]


def displacement(run):
    with run.fields() as file:
        points, u = file["points"][()], file["displacement"][()]
    # coincident nodes of two bodies are told apart by the sides they are on: the order of their displacements
    return u[np.lexsort(np.round(np.column_stack([u[:, 1] / np.abs(u).max(), points]), 7).T)]


def judge_variant(run, **expected):
    """One more scene made from this one; returns it."""
    check = run.summary["solver"]["cross_check"]
    require(check["agree"], f"the solvers disagree by {check['displacement_difference']:.3g}")
    same("verdict", run.summary["solvability"]["verdict"], expected["verdict"])
    if "force" in expected:
        near("force", run.pair("joint")["force"], expected["force"], absolute=1e-9 * max(map(abs, expected["force"])))
    return run


def judge_reference(run):
    """Independent high-order solution: -0.0045621367(1), energies of the bodies, arm 5/9."""
    for order, accuracy in ((1, 5e-3), (2, 3e-4)):
        fine = run.again("-order", str(order), name=f"order{order}")
        near("potential", fine.summary["energy"]["potential"], -0.0045621367, relative=accuracy)
        near("strain energy above", fine.summary["energy"]["strain"]["upper"], 0.00305130805, relative=accuracy)
        near("force", fine.pair("joint")["force"], [0, 3], absolute=3e-9)
        near("arm", fine.pair("joint")["centre_of_pressure"][0], 5 / 9, relative=1e-9)


def judge_position(run):
    """The upper block is free to slide and does not: its displacement along x is zero in the mean (bilinear cells, trapezoidal rule)."""
    with run.fields() as file:
        points, u = file["points"][()], file["displacement"][()]
        upper = np.unique(file["cells"][()][file["body"][()] == 0])
    x, y = points[upper, 0], points[upper, 1]
    weight = np.where((x == 0) | (x == 1), 0.5, 1) * np.where((y == 0) | (y == 1), 0.5, 1)
    mean = (weight * u[upper, 0]).sum() / weight.sum()
    near("mean displacement along x", mean, 0, absolute=1e-12 * np.abs(u).max())
    free = run.summary["solvability"]["free_motions"]
    same("free motions", [sorted(motion) for motion in free], [["upper"]])
    near("free motion", free[0]["upper"]["translation"] + [free[0]["upper"]["rotation"]], [1, 0, 0], absolute=1e-12)


def judge(run):
    judge_variant(run, verdict="free_motion", force=[0, 3])
    judge_position(run)
    mine = displacement(run)
    for n, options in enumerate(SOLVERS):
        other = run.again("-cross_check", "0", *options, name=f"solver{n}")
        near(f"displacement with {' '.join(options)}", displacement(other).ravel(), mine.ravel(), relative=1e-8)
    other = run.again("-cross_check", "0", ranks=3, name="ranks")
    near("displacement on three ranks", displacement(other).ravel(), mine.ravel(), relative=1e-9)
    judge_reference(run)
    # held in part: it may slide along y only, and presses against its support; contact holds the rest
    judge_variant(run.again("-upper_bc_normal", "left", "-upper_body_force", "-0.3,-1", name="partly"), verdict="solvable", force=[0, 3])
    judge_variant(run.again("-joint_gap", "-1e-3", name="overlap"), verdict="free_motion", force=[0, 3])
    judge_variant(run.again("-joint_type", "tied", "-upper_body_force", "0.3,4", name="tied"), verdict="solvable", force=[-0.3, -2])
    # a gap of a hundred thousand times the displacements to come is crossed at once, and the pressure is what it was
    wide = judge_variant(run.again("-joint_gap_offset", "100", name="wide"), verdict="free_motion")
    near("force behind a gap", wide.pair("joint")["force"], [0, 3], absolute=1e-7)
    near("potential behind a gap", wide.summary["energy"]["potential"], run.summary["energy"]["potential"] - 300, relative=1e-10)
    judge_idle(run)
    judge_verge(run)


def judge_idle(run):
    """A block without loads is where it was, whatever happens below it."""
    idle = run.again("-upper_body_force", "0,0", "-upper_bc_traction_top", "0,0", "-lower_bc_traction", "right", "-lower_bc_traction_right", "0,-1",
                     name="idle")
    judge_variant(idle, verdict="free_motion")
    same("free motions of an idle block", len(idle.summary["solvability"]["free_motions"]), 3)
    near("force of an idle block", idle.pair("joint")["normal_force"], 0, absolute=1e-10)
    still = run.again("-upper_body_force", "0,0", "-upper_bc_traction_top", "0,0", name="still")
    near("energy of nothing", still.summary["energy"]["potential"], 0, absolute=0)


def judge_verge(run):
    """The load just over the edge: solved, and warned of, because the edge carries all of it."""
    verge = Run(run.program, run.mpiexec, run.ranks, run.folder / "verge",
                run.arguments + ["-lower_dm_plex_box_upper", "0.5,0", "-upper_bc_traction_top", "0,0"])
    same("exit code on the verge", verge.exit, 0)
    require("warning" in verge.stderr and "tips about (0.5, 0)" in verge.stderr, "no warning on the verge")
    judge_variant(verge, verdict="marginal", force=[0, 1])
    require("tips about (0.5, 0)" in verge.summary["solvability"]["sentence"], "the summary does not tell what the warning tells")
    verge.again("-quiet", name="quiet", warns=["coarse_contact", "free_motion", "marginal", "model_limit"])  # which is not said, but in the summary
    require("gathers at an edge" in verge.stderr, "it is not said where the pressure goes")
    near("place of the force", verge.pair("joint")["centre_of_pressure"], [0.5, 0], absolute=1e-9)
