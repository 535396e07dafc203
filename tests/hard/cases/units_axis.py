"""Lengths in other units: slopes of the formula are those over a part of a facet, not of its ring, which is an area."""
from judge import near, same


def judge(run):
    same("nodes with a multiplier", run.summary["scene"]["pairs"]["joint"]["candidates"], 11)
    for length in (1e-3, 1e3):
        other = run.again("-ring_map", f"{length}*x,{length}*(y+0.0015*abs(x-5.9)*(1-y))", "-ring_bc_displacement_top", f"free,{-0.003 * length!r}",
                          "-joint_obstacle_gap", f"sqrt(1+0.0015^2)*(y-{0.00015 * length!r}+{0.001 * length!r}*(6-x/{length!r})^3)", name=f"length_{length:g}")
        same(f"nodes with a multiplier, unit {length}", other.summary["scene"]["pairs"]["joint"]["candidates"], 11)
        near(f"force, unit {length}", other.pair("joint")["normal_force"] / length**2, run.pair("joint")["normal_force"], relative=1e-10)
