"""-load_steps_scale displacements: the loads of two_plates stay whole, so that every step is the scene without steps."""
from judge import Run, near, same


def judge(run):
    whole = Run(run.program, run.mpiexec, run.ranks, run.folder / "whole", run.arguments[: run.arguments.index("-load_steps")])
    whole.require_solved()
    for step in run.summary["steps"]:
        same("iterations after the first", step["iterations"] > 1, step["t"] == 0.5)
        near("force", step["pairs"]["joint"]["force"], whole.pair("joint")["force"], relative=1e-9)
    halves = run.again("-load_steps_scale", "loads", name="loads").summary["steps"]
    for step in halves:  # loads alone, no gap: proportional
        expected = [step["t"] * x for x in whole.pair("joint")["force"]]
        near("force of scaled loads", step["pairs"]["joint"]["force"], expected, relative=1e-9)
