"""A run without a solution does not end the study; the study ends with 3 and says which one it was."""
from judge import Run, require, same
from studies import rows


def judge(run):
    other = Run(run.program, run.mpiexec, run.ranks, run.folder / "short", run.arguments + ["-study_levels", "2", "-study_orders", "1,2", "-snes_max_it", "1"])
    other.require_clean()
    same("exit code", other.exit, 3)
    nothing = Run(run.program, run.mpiexec, run.ranks, run.folder / "nothing", run.arguments + ["-study_levels", "1", "-study_orders", "1", "-snes_max_it", "1", "-report"])
    same("exit code", nothing.exit, 3)
    require("-report: no report was written: no run is solved" in nothing.stderr and "mortise-report" not in nothing.stderr, nothing.stderr)
    table = rows(other)
    same("rows", len(table), 4)
    require("not_solved" in [row["status"] for row in table], "with one step all runs are solved")
    require(all(row["reason"] for row in table if row["status"] == "not_solved"), "a failure has no reason")
    require("mortise: order 1, level 0 is not solved: " in other.stderr, other.stderr)
