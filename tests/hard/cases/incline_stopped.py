"""The weight along both normals."""
from judge import near


def judge(run):
    near("slope", run.pair("joint")["force"], [-0.6 * 0.8, 0.8 * 0.8], absolute=1e-10)
    near("stop", run.pair("stop")["force"], [0.8 * 0.6, 0.6 * 0.6], absolute=1e-10)
