"""A run without a solution takes the fields of an earlier run of that name away: they are not its own. So does any run without -paths with the
table of paths, and a run of one solution with the tables of load steps and of a study. Load steps and studies keep their own."""
from judge import NAME, same
from world import files, finish, start

PUSHED = ["-block_bc_traction", "left", "-block_bc_traction_left", "0.1,0"]


def judge(run):
    tables = [run.folder / f"{NAME}_{kind}.csv" for kind in ("paths", "steps", "study")]
    for options, kept in (([], []), (["-load_steps", "2"], ["steps"]), (["-study", "uniform", "-study_levels", "2"], ["study"])):
        for table in tables:
            table.write_text("of an earlier run\n")
        same("exit code of the same run", finish(start(run, *options))[0], 0)
        same("tables that stay", [kind for kind, table in zip(("paths", "steps", "study"), tables) if table.exists()], kept)
        same("tables of an earlier run", [table.name for table in tables if table.exists() and "earlier" in table.read_text()], [])
    for table in tables:
        table.write_text("of an earlier run\n")
    code, _, _ = finish(start(run, *PUSHED))
    same("exit code", code, 2)
    same("status", run.summary["status"], "no_solution")
    same("files", sorted(files(run)), [f"{NAME}{ending}" for ending in (".h5", ".json", ".xdmf")])
