"""Friction of a ball that is pressed on a block, on three facets, with an error of 9 %. Its largest slip is where contact ends. What that facet dissipates is known to
half of itself: a mesh of 16 680 unknowns has the dissipation 0.001900673, known to 1.1e-5."""
from judge import Run, near, require, same


def judge(run):
    coarse = Run(run.program, run.mpiexec, run.ranks, run.folder / "meshes", run.arguments)
    same("exit", coarse.exit, 3)  # by the limit on meshes
    value, bar = (results["pairs"]["joint"]["dissipation"] for results in (coarse.summary, coarse.summary["bars"]))
    near("dissipation", value, 0.001900673, absolute=bar)
    require(bar < 0.4 * value, f"the bar of the dissipation says nothing: {bar}")
