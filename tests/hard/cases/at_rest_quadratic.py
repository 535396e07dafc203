"""Stresses are roundoff of the displacements."""
from judge import near


def judge(run):
    pressures = run.table("joint")["pressure"]
    near("pressure", pressures, [0] * len(pressures), absolute=1e-9)
    for solved in (run, run.again("-snes_pdas_start", "full", name="full")):
        near("energy", sum(solved.summary["energy"]["strain"].values()), 0, absolute=1e-20)
