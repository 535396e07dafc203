"""A run without a solution takes the fields of an earlier run of that name away: they are not its own. So does any run without -paths with the
table of paths."""
from judge import NAME, same
from world import files, finish, start

PUSHED = ["-block_bc_traction", "left", "-block_bc_traction_left", "0.1,0"]


def judge(run):
    table = run.folder / f"{NAME}_paths.csv"
    table.write_text("path,length\n")
    same("exit code of the same run", finish(start(run))[0], 0)
    same("table of paths", table.exists(), False)
    table.write_text("path,length\n")
    code, _, _ = finish(start(run, *PUSHED))
    same("exit code", code, 2)
    same("status", run.summary["status"], "no_solution")
    same("files", sorted(files(run)), [f"{NAME}{ending}" for ending in (".h5", ".json", ".xdmf")])
