"""A run without a solution takes the fields of an earlier run of that name away: they are not its own."""
from judge import NAME, same
from world import files, finish, start

PUSHED = ["-block_bc_traction", "left", "-block_bc_traction_left", "0.1,0"]


def judge(run):
    code, _, _ = finish(start(run, *PUSHED))
    same("exit code", code, 2)
    same("status", run.summary["status"], "no_solution")
    same("files", sorted(files(run)), [f"{NAME}{ending}" for ending in (".h5", ".json", ".xdmf")])
