"""Where no mesh of a study has a solution, its files hold the motion that shows it; where a finer mesh has one, that solution."""
from judge import Run, near, require, same

TIPPED = ["-block_dm_plex_box_lower", "0.3,0", "-block_dm_plex_box_upper", "1.3,1", "-study_levels", "2"]
# the load stands at 0.51, the table ends at 0.513, and of nodes half a length apart the last that can press is at 0.5
COARSE = ["-block_dm_plex_box_faces", "2,2", "-block_bc_traction", "right", "-block_bc_traction_right", "0,-0.0204"]
COARSE += ["-table_dm_plex_box_upper", "0.513,0", "-study_levels", "3"]


def study(run, name, options):
    return Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + options)


def fields(run):
    with run.fields() as file:
        return set(file)


def judge(run):
    tipped = study(run, "tipped", TIPPED)
    tipped.require_clean()
    same("exit code", tipped.exit, 2)
    same("status", tipped.summary["status"], "no_solution")
    same("runs", len(tipped.summary["study"]["runs"]), 2)
    near("centre", tipped.summary["solvability"]["motion"]["block"]["centre"], [0.7, 0], absolute=1e-9)
    require("motion" in fields(tipped) and "displacement" not in fields(tipped), f"fields {fields(tipped)}")
    coarse = study(run, "coarse", COARSE)
    coarse.require_clean()
    same("exit code of the other", coarse.exit, 3)
    require("order 1, level 0 is not solved: there is no solution on this mesh: body block tips" in coarse.stderr, coarse.stderr)
    same("what is solved", [entry["status"] for entry in coarse.summary["study"]["runs"]], ["not_solved", "solved", "solved"])
    same("status of the other", coarse.summary["status"], "solved")
    require("displacement" in fields(coarse) and "motion" not in fields(coarse), f"fields {fields(coarse)}")
