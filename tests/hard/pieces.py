"""A body of two pieces, one of which only contact holds: it is the pieces that move, and are told of."""
from judge import Run, near, require, same

RIGHT, LEFT = "lids, piece 2 of 2 near (2.5, 0.5)", "lids, piece 1 of 2 near (0.5, 0.5)"
PULLED = ["-lids_bc_traction", "cap", "-lids_bc_traction_cap", "0,1.5"]  # against a weight of 1
PUSHED = ["-lids_bc_traction", "cheek", "-lids_bc_traction_cheek", "0.1,0"]
SWAPPED = ["-joint_nonmortar", "table:top", "-joint_mortar", "lids:foot"]
LOOSE = ["-lids_bc_displacement_held", "free,free", "-options_allow_unused"]
REFUSED = {  # options, who, what it does, translation, work
    "pulled": (PULLED, RIGHT, "lifts off along (0, 1)", [0, 1], 0.5),
    "pushed": (PUSHED, RIGHT, "slides along (1, 0)", [1, 0], 0.1),
    "pushed_mortar": (PUSHED + SWAPPED, RIGHT, "slides along (1, 0)", [1, 0], 0.1),
    "loose": (LOOSE, LEFT, "which no contact touches, moves along (0, -1)", [0, -1], 1.0),
}


def judge_held(run):
    near("force", run.pair("joint")["force"], [0, run.pair("joint")["normal_force"]], absolute=1e-12)
    near("weight", run.pair("joint")["normal_force"], 1, relative=1e-9)
    near("arm", run.pair("joint")["centre_of_pressure"], [2.5, 0], absolute=1e-9)
    near("weight of the other", run.summary["reactions"]["lids:held"], [0, 1], absolute=1e-9)
    solvability = run.summary["solvability"]
    same("verdict", solvability["verdict"], "free_motion")
    same("floating", run.summary["scene"]["bodies"]["lids"]["floating"], True)
    same("free motions", [list(motion) for motion in solvability["free_motions"]], [[RIGHT]])
    same("body", solvability["free_motions"][0][RIGHT]["body"], "lids")
    near("free motion", solvability["free_motions"][0][RIGHT]["translation"], [1, 0], absolute=1e-9)
    require(run.summary["solver"]["cross_check"]["agree"], "the solvers disagree")


def judge(run):
    judge_held(run)
    for name, (options, who, does, translation, work) in REFUSED.items():
        case = Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + options)
        same(f"exit code of {name}", case.exit, 2)
        require(f"no solution: body {who}, {does}" in case.stderr, f"{name}: {case.stderr!r}")
        case.require_clean()
        motion = case.summary["solvability"]["motion"]
        same(f"what moves, {name}", list(motion), [who])
        near(f"translation, {name}", motion[who]["translation"], translation, absolute=1e-9)
        near(f"work, {name}", case.summary["solvability"]["work"], work, relative=1e-9)
