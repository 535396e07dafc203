"""Limits end the refinement: exit code 3, a sentence, results and bars."""
from judge import Run, near, require, same


def judge(run):
    for option, value, says in (("-adapt_max_meshes", "5", "-adapt_max_meshes 5 ends"), ("-adapt_max_unknowns", "600", "-adapt_max_unknowns allows 600")):
        other = Run(run.program, run.mpiexec, run.ranks, run.folder / option, run.arguments + [option, value])
        same("exit", other.exit, 3)
        require(says in other.stderr, f"{other.stderr} does not say {says}")
        require("PETSC ERROR" not in other.stderr, "PETSc's trace is shown")
        same("status", other.summary["status"], "not_converged")
        same("warnings", [w["code"] for w in other.summary["warnings"] if w["code"] not in ("model_limit", "coarse_contact")], [])
        meshes, bars = other.summary["estimate"]["meshes"], other.summary["bars"]
        near("force", other.pair("joint")["normal_force"], 1836995.08, absolute=bars["pairs"]["joint"]["normal_force"])
        same("meshes", [m["cells"] for m in meshes], [m["cells"] for m in run.summary["estimate"]["meshes"]][:len(meshes)])
        require(meshes[-1]["unknowns"] <= 600, f"{meshes[-1]} has too many unknowns")
        require((other.folder / "result.h5").is_file(), "no fields are written")
