"""Scenes on which the plain iteration runs in a circle."""
from judge import near, require

MOST = 40  # steps: the circle has to be seen, and then each step changes a few nodes


def judge(run):
    require(run.summary["solver"]["safeguarded"], "the plain iteration did not run in a circle")
    require(run.summary["solver"]["iterations"] <= MOST, "the safeguard took long")
    table = run.table("corners")
    strongest = max(table["pressure"])
    for start in ("full", "gap"):
        other = run.again("-snes_pdas_start", start, name=start).table("corners")
        near(f"pressures from a {start} set", other["pressure"], table["pressure"], absolute=1e-8 * strongest)
    require(min(table["pressure"]) > -1e-9 * strongest, "it pulls")
    require(min(gap for gap in table["gap"] if gap == gap) > -1e-12, "it overlaps")
