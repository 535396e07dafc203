"""Strain -2e-6 along both axes; quadrilaterals of both orders, triangles of order 2."""
from judge import near

def judge_uniform(run, pairs, pressure=1, accuracy=1e-10):
    for name in pairs:
        table = run.table(name)
        found = [p for p, status in zip(table["pressure"], table["status"]) if status != -1]
        near(f"pressure of {name}", found, [pressure] * len(found), relative=accuracy)


def judge(run):
    for kind in (["-order", "1"], ["-order", "2"], ["-order", "2", "-block_dm_plex_simplex", "1"]):
        judge_uniform(run.again(*kind, name="_".join(kind).replace("-", "")), run.summary["pairs"], 2e-3 / (1.4999 * 2e-4), accuracy=1e-9)
