"""-warnings error: exit code 3 with all results written, whatever kind of run has a warning; 0 without one, 2 where there is no solution."""
from judge import Run, require, same

KINDS = {"alone": [], "quiet": ["-quiet"], "unused": ["-options_allow_unused", "-block_yung", "1"], "study": ["-study", "uniform", "-study_levels", "2"],
         "steps": ["-load_steps", "0.5,1"], "check": ["-check", "-block_body_force", "5,0"], "report": ["-report"]}


def judge_kind(run, name, options):
    """With -warnings error the same files and the same warnings as without."""
    told, strict = (Run(run.program, run.mpiexec, run.ranks, run.folder / f"{name}{len(more)}", run.arguments + options + more)
                    for more in ([], ["-warnings", "error"]))
    strict.require_clean()
    same(f"{name}: exit codes", (told.exit, strict.exit), (0, 3))
    same(f"{name}: warnings", strict.summary["warnings"], told.summary["warnings"])
    require(strict.summary["warnings"], f"{name} has no warnings")
    same(f"{name}: status", strict.summary["status"], "checked" if name == "check" else "solved")
    files = [sorted(path.name for path in case.folder.iterdir()) for case in (told, strict)]
    same(f"{name}: files", files[1], files[0])
    require("mortise: -warnings error: " in strict.stderr and "the results are complete" in strict.stderr, strict.stderr)
    for warning in strict.summary["warnings"]:
        require(f"[{warning['code']}]" in strict.stderr, f"{name}: stderr does not tell {warning}")


def judge(run):
    for name, options in run.some(KINDS.items()):
        judge_kind(run, name, options)
    beyond = Run(run.program, run.mpiexec, run.ranks, run.folder / "beyond", run.arguments + ["-block_body_force", "5,0", "-warnings", "error"])
    same("exit code without a solution", beyond.exit, 2)
    held = ["-table_dm_plex_box_upper", "1,0", "-block_bc_normal", "left", "-warnings", "error"]
    run.again(*held, name="held", warns=[])
