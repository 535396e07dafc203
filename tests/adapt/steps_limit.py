"""Load steps whose meshes come to a limit. The exit code is 3, what was solved before is kept, the step that was not has all its
numbers."""
from judge import Run, read_table, require, same


def judge(run):
    largest = run.summary["steps"][0]["estimate"]["meshes"][-1]["unknowns"]
    other = Run(run.program, run.mpiexec, run.ranks, run.folder / "limit", run.arguments + ["-adapt_max_unknowns", str(1.2 * largest)])
    same("exit", other.exit, 3)
    require("-adapt_max_unknowns allows" in other.stderr and "the last solution is that of t = 0.2" in other.stderr, other.stderr)
    same("steps", [step["status"] for step in other.summary["steps"]], ["solved", "not_converged"])
    same("rows", list(read_table(other.folder / "result_steps.csv")["status"]), ["solved", "not_converged"])
    same("first step", other.summary["steps"][0]["pairs"], run.summary["steps"][0]["pairs"])
    require(other.summary["bars"]["pairs"]["joint"]["normal_force"] > 0, "no bars")
