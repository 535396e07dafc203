"""Memory ends the refinement before it is used up: exit code 3, a sentence, results and bars."""
from judge import Run, require, same


def judge(run):
    # Twice what any process takes: the pages of libraries that are in memory vary by ten megabytes.
    limit = 1.1e8
    require(run.summary["memory"]["peak_bytes"] < limit, "meshes are not what takes the memory")
    arguments = [one if one != "2e-2" else "1e-6" for one in run.arguments]
    other = Run(run.program, run.mpiexec, run.ranks, run.folder / "limited", arguments + ["-study_memory", f"{limit:.0f}"])
    same("exit", other.exit, 3)
    require("the next mesh would need about" in other.stderr and "-study_memory allows" in other.stderr, other.stderr)
    require("PETSC ERROR" not in other.stderr, "PETSc's trace is shown")
    same("status", other.summary["status"], "not_converged")
    require(other.summary["memory"]["peak_bytes"] <= 1.1 * limit, f"{other.summary['memory']['peak_bytes']} bytes were taken, {limit} are allowed")
    require(other.summary["bars"]["pairs"]["joint"]["normal_force"] > 0, "no bars")
    require((other.folder / "result.h5").is_file(), "no fields are written")
