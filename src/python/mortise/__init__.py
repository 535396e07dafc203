"""Mortise from Python: runs scenes and reads their results.

    import mortise

    run = mortise.run("press.opts", {"fit_gap": -0.03}, output="results/press")
    run.summary.pairs.fit.normal_force      # the JSON summary, by keys or by attributes
    run.table("fit")["pressure"]            # a CSV table as a structured array
    run.fields()["hub"].displacement        # fields of a body, [nodes][3]

    rows = mortise.sweep("press.opts", [{"fit_gap": -g} for g in (0.01, 0.02)], {"force": "pairs.fit.normal_force"})
    rows.write("press.csv")

The program is the one of `$MORTISE`, else the one of the same installation, of the `PATH`, or of the build tree. Units are those of the
scene. The package needs numpy; fields need h5py."""
from .errors import MortiseError, MortiseWarning, NoSolutionError, NotConvergedError, ProgramError, ResultError, RunTimeoutError, SceneError
from .program import Run, find_program, run
from .results import BodyFields, Results, Summary, load, read_table
from .scene import arguments_of
from .sweep import Rows, grid, sweep

__version__ = "0.2.0"
__all__ = ["BodyFields", "MortiseError", "MortiseWarning", "NoSolutionError", "NotConvergedError", "ProgramError", "ResultError", "Results",
           "Rows", "Run", "RunTimeoutError", "SceneError", "Summary", "arguments_of", "find_program", "grid", "load", "read_table", "run", "sweep"]
