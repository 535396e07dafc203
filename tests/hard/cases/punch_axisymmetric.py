"""Sneddon: F = 2 a E* d. The rim of the drum, fifty radii away, holds it up a little."""
from judge import near


def judge(run):
    half_space = 2 * 1e3 / 0.91 * 0.01
    near("force", run.pair("joint")["normal_force"], half_space, relative=0.05)
    near("force on cells of half the size", run.again("-dm_refine", "1", name="fine").pair("joint")["normal_force"], half_space, relative=0.03)
