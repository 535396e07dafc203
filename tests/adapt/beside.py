"""A rigid spike 0.2 deep between two nodes of a block under shear: it is detected, although the loads leave roundoff as tractions of open
nodes. A spike beside the block, in the straight continuation of its first or last facet, touches nothing."""
from judge import near, same


def judge(run):
    (warning,) = run.summary["warnings"]
    same("warning", warning["code"], "hidden_contact")
    near("its place", warning["at"], [0.56, 1], absolute=1e-4)
    for at in ("1.1", "(-0.1)"):
        beside = run.again("-tool_obstacle_gap", f"0.1 - 0.3*exp(-((x-{at})/0.01)^2)", "-block_bc_traction_left", "0,0")
        same(f"warnings of a spike at {at}", [each["code"] for each in beside.summary["warnings"]], ["no_load"])
        same(f"estimated error of a spike at {at}", beside.summary["estimate"]["energy_norm_relative"], 0)
