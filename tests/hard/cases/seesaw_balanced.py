"""The post carries the weight, in its middle; pressure and gap are the same on both sides."""
from judge import near


def judge(run):
    near("force", run.pair("edge")["force"], [0, 0.4], absolute=1e-11)
    near("centre", run.pair("edge")["centre_of_pressure"], [0, 0], absolute=1e-10)
    table = run.table("edge")
    rows = sorted(zip(table["x"], table["pressure"]))
    near("pressure, mirrored", [p for _, p in reversed(rows)], [p for _, p in rows], relative=1e-9)
