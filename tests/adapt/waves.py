"""A body force that no node sees: the solution is zero, and so is its recovered stress; the oscillation alone tells the error. Resolved, it adds little."""
from judge import near, require


def judge(run):
    near("displacement", run.summary["errors"]["plate"]["energy_relative"], 1, relative=1e-2)
    compare(run.summary, 0.8, 1.4)
    compare(run.again("-dm_refine", "2", name="waves_of_four_cells").summary, 1, 1.35)
    adapted = run.again("-order", "2", "-adapt", "0.05", name="adapted").summary
    require(len(adapted["estimate"]["meshes"]) >= 3, "the first mesh is taken for exact")
    require(adapted["errors"]["plate"]["energy_relative"] < 0.1, f"a relative error of {adapted['errors']['plate']['energy_relative']} is left")


def compare(summary, least, most):
    effectivity = summary["estimate"]["energy_norm"] / summary["errors"]["plate"]["energy"]
    require(least <= effectivity <= most, f"effectivity {effectivity}")
