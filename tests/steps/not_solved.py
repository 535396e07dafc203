"""A step that is not solved ends the run with 3; the steps before are kept, and the last of them is named."""
from judge import NAME, Run, near, read_table, require, same

LOADS = {"upper_bc_traction_left": (3e6, -4e6), "lower_bc_traction_right": (-3e6, -7e6)}


def judge(run):
    options = ["-snes_max_it", "1", "-load_steps", "0.1,0.2,0.9,1"]  # nothing happens at first; then one set is not enough
    for name, load in LOADS.items():
        options += [f"-{name}", ",".join(f"{value}*max(t-0.2,0)" for value in load)]
    ended = Run(run.program, run.mpiexec, run.ranks, run.folder / "short", run.arguments + options)
    ended.require_clean()
    same("exit code", ended.exit, 3)
    same("status", [step["status"] for step in ended.summary["steps"]], ["solved", "solved", "not_converged"])
    same("status of all", ended.summary["status"], "not_converged")
    near("nothing happens at first", ended.summary["steps"][1]["pairs"]["joint"]["normal_force"], 0, absolute=1e-9)
    require("mortise: not solved at t = 0.9; the last solution is that of t = 0.2" in ended.stderr, ended.stderr)
    same("rows", read_table(ended.folder / f"{NAME}_steps.csv")["t"], [0.1, 0.2, 0.9])
