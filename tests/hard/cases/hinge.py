"""The corner takes forces and no moments: what is about it is the table's."""
from judge import Run, near, require, same

METHODS = {"each": ["-snes_pdas_reduce", "0"], "multigrid": ["-pc_type", "truncatedmg"], "refined": ["-pc_type", "truncatedmg", "-dm_refine", "1"]}
PULLED = {"each": (), "multigrid": ("-pc_type", "truncatedmg")}


def judge_moment(run, name):
    joint = run.pair("joint")
    near(f"moment of {name}", joint["normal_force"] * (joint["centre_of_pressure"][0] - 1), 0.5, relative=1e-8)


def judge(run):
    judge_moment(run, "the scene")
    for name, options in METHODS.items():
        other = Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + options)
        same(f"exit code, {name}", other.exit, 0)
        require(other.summary["solver"]["cross_check"]["agree"], f"solvers disagree, {name}")
        judge_moment(other, name)
    for name, options in PULLED.items():
        other = Run(run.program, run.mpiexec, run.ranks, run.folder / f"pulled_{name}", run.arguments + ["-squares_body_force", "0,1", *options])
        same(f"exit code where nothing holds, {name}", other.exit, 3)
