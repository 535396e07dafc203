"""A step without a solution ends the run with 2; the steps before are kept, and the last of them is named."""
import h5py

from judge import NAME, Run, near, read_table, require, same

LIFTED = ["-block_body_force", "0,2*(t-0.5)", "-load_steps", "0.1,0.4,0.7,1"]  # pulled up beyond t = 0.5
NEVER = ["-block_body_force", "0,1", "-load_steps", "0.1,0.4"]


def other(run, name, options):
    ended = Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + options)
    ended.require_clean()
    require("PETSC ERROR" not in ended.stderr, ended.stderr)
    return ended


def judge(run):
    lifted = other(run, "lifted", LIFTED)
    same("exit code", lifted.exit, 2)
    summary = lifted.summary
    same("status", [step["status"] for step in summary["steps"]], ["solved", "solved", "no_solution"])
    same("status of all", summary["status"], "no_solution")
    near("force at t = 0.4", summary["steps"][1]["pairs"]["joint"]["normal_force"], 0.2, relative=1e-9)
    same("no force", summary["steps"][2]["pairs"]["joint"]["normal_force"], None)
    require("there is no solution at t = 0.7; the last solution is that of t = 0.4" in lifted.stderr, lifted.stderr)
    same("rows", read_table(lifted.folder / f"{NAME}_steps.csv")["t"], [0.1, 0.4, 0.7])
    with h5py.File(lifted.folder / f"{NAME}.h5", "r") as file:
        same("fields", list(file["steps"]), ["0001", "0002"])
    never = other(run, "never", NEVER)
    same("exit code without any", never.exit, 2)
    require("this is the first load step" in never.stderr, never.stderr)
    with h5py.File(never.folder / f"{NAME}.h5", "r") as file:
        require("motion" in file and "displacement" not in file, f"fields {list(file)}")
