"""Strain -0.002 along every axis: pressure 0.002 E / ((1 + nu) (1 - 2 nu)), at faces, edges and corners alike."""
from judge import near

def judge_uniform(run, pairs, pressure=1, accuracy=1e-10):
    for name in pairs:
        table = run.table(name)
        found = [p for p, status in zip(table["pressure"], table["status"]) if status != -1]
        near(f"pressure of {name}", found, [pressure] * len(found), relative=accuracy)


def judge(run):
    for kind in (["-order", "1"], ["-order", "2"], ["-block_dm_plex_simplex", "1"]):
        judge_uniform(run.again(*kind, name="_".join(kind).replace("-", "")), run.summary["pairs"], 2 / (1.3 * 0.4))
    near("potential", run.summary["energy"]["potential"], 0.5 * 0.002 * 2 * 2 / (1.3 * 0.4), relative=1e-10)
