"""Weight on the floor, nothing on the wall, and no word of an edge."""
from judge import near, require


def judge(run):
    near("floor", run.pair("floor")["force"], [0, 1], absolute=1e-9)
    near("wall", run.pair("wall")["force"], [0, 0], absolute=1e-9)
    require("edge" not in run.stderr, run.stderr)
