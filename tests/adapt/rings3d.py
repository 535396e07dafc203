"""Rings from files whose sides are taken for smooth. New nodes are on the circles, also in the middle of faces, and where hexahedra were cut.
Lame's pressure lies within its bar."""
from judge import near

PRESSURE = 0.128781


def judge(run):
    near("mean pressure", run.pair("fit")["mean_pressure"], PRESSURE, absolute=run.summary["bars"]["pairs"]["fit"]["mean_pressure"])
    near("mean pressure", run.pair("fit")["mean_pressure"], PRESSURE, relative=1e-2)
    if "kept" not in run.arguments:
        return
    linear = run.again("-order", "1", "-adapt", "0.08", name="linear")  # with twice the unknowns mesh 3 has the error of mesh 2, less a tenth
    near("order 1: force", linear.pair("fit")["force"][0], PRESSURE * 2, relative=0.02)
