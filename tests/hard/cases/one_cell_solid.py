"""Uniform stress: pressure 1 at every node that carries one; cells of all kinds."""
from judge import near

KINDS = [("-upper_dm_plex_simplex", s, "-lower_dm_plex_simplex", t, "-order", o) for s in "01" for t in "01" for o in "12"]


def judge(run):
    for number, kind in enumerate(KINDS):
        solved = run.again(*kind, name=f"kind{number}")
        table = solved.table("joint")
        pressures = [p for p, status in zip(table["pressure"], table["status"]) if status == 1]
        near(f"pressure with {' '.join(kind)}", pressures, [1] * len(pressures), absolute=1e-10)
        near("force", solved.pair("joint")["normal_force"], 1, absolute=1e-10)
        near("potential", solved.summary["energy"]["potential"], -0.5 * (1 / 1000 + 1 / 2000), relative=1e-10)
