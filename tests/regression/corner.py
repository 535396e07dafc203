"""A side that turns a sharp corner presses as the part of it does that sees the other side."""
from judge import near, same


def judge(run):
    alone = run.again("-floor_nonmortar", "block:bottom", name="alone")
    near("force", run.pair("floor")["force"], alone.pair("floor")["force"], relative=1e-12)
    near("sideways", run.pair("floor")["force"][0], 0.0, absolute=1e-12 * run.pair("floor")["normal_force"])
    same("nodes in contact", run.pair("floor")["active_nodes"], alone.pair("floor")["active_nodes"])
