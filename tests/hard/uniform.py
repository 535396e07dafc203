"""States that are the same everywhere."""
from judge import near

KINDS = [("-upper_dm_plex_simplex", s, "-lower_dm_plex_simplex", t, "-order", o) for s in "01" for t in "01" for o in "12"]


def judge_uniform(run, pairs, pressure=1, accuracy=1e-10):
    """One pressure at every node that carries one."""
    for name in pairs:
        table = run.table(name)
        found = [p for p, status in zip(table["pressure"], table["status"]) if status != -1]
        near(f"pressure of {name}", found, [pressure] * len(found), relative=accuracy)


def judge_cells(run, potential):
    """Pressure and force 1 with cells of all kinds."""
    for number, kind in enumerate(KINDS):
        solved = run.again(*kind, name=f"kind{number}")
        table = solved.table("joint")
        pressures = [p for p, status in zip(table["pressure"], table["status"]) if status == 1]
        near(f"pressure with {' '.join(kind)}", pressures, [1] * len(pressures), absolute=1e-10)
        near("force", solved.pair("joint")["normal_force"], 1, absolute=1e-10)
        near("potential", solved.summary["energy"]["potential"], potential, relative=1e-10)


def judge_box(run, pressure, dim):
    """A block with the strain -0.002 along every axis, in cells of both orders and of both shapes."""
    for kind in (["-order", "1"], ["-order", "2"], ["-block_dm_plex_simplex", "1"]):
        judge_uniform(run.again(*kind, name="_".join(kind).replace("-", "")), run.summary["pairs"], pressure)
    near("potential", run.summary["energy"]["potential"], 0.5 * 0.002 * dim * pressure, relative=1e-10)
