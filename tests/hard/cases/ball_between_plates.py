"""Forces, and turns that are free."""
from judge import near, same


def judge(run):
    near("force below", run.pair("below")["force"], [0, 0, 8], absolute=1e-9)
    near("force above", run.pair("above")["force"], [0, 0, -8], absolute=1e-9)
    same("free motions", len(run.summary["solvability"]["free_motions"]), 3)
    for motion in run.summary["solvability"]["free_motions"]:
        near("axis through the middle", motion["ball"]["centre"], [0, 0, 0], absolute=1e-9)
