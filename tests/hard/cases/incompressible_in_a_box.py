"""Strain -2e-6 along both axes; quadrilaterals of both orders, triangles of order 2."""
from uniform import judge_uniform


def judge(run):
    for kind in (["-order", "1"], ["-order", "2"], ["-order", "2", "-block_dm_plex_simplex", "1"]):
        judge_uniform(run.again(*kind, name="_".join(kind).replace("-", "")), run.summary["pairs"], 2e-3 / (1.4999 * 2e-4), accuracy=1e-9)
