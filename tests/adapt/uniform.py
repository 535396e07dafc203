"""Levels of a uniform study: bars hold the known limits from the third level on, and there are none before; the last order's meshes count."""
from judge import near, require, same

POTENTIAL, FORCE = -5918.26337, 1836995.08  # independent high-order reference


def judge(run):
    full = run.summary
    known(full)
    meshes = full["estimate"]["meshes"]
    same("meshes", [mesh["unknowns"] for mesh in meshes], [row["unknowns"] for row in full["study"]["runs"]])
    short = run.again("-study_levels", "3", name="three").summary
    known(short)
    require(short["bars"]["energy"]["potential"] > 5 * full["bars"]["energy"]["potential"], "bars do not shrink")
    pair = run.again("-study_levels", "2", name="two").summary
    same("bars of two levels", pair["bars"], None)
    same("meshes of two levels", pair["estimate"]["meshes"], [])
    orders = run.again("-study_levels", "3", "-study_orders", "1,2", name="orders").summary
    same("meshes of the higher order", [mesh["unknowns"] for mesh in orders["estimate"]["meshes"]], [mesh["unknowns"] for mesh in meshes[:3]])
    near("bar beside another order", orders["bars"]["energy"]["potential"], short["bars"]["energy"]["potential"], relative=1e-4)


def known(summary):
    """Limits within the bars, and bars that say something."""
    bars = summary["bars"]
    near("potential", summary["energy"]["potential"], POTENTIAL, absolute=bars["energy"]["potential"])
    near("force", summary["pairs"]["joint"]["normal_force"], FORCE, absolute=bars["pairs"]["joint"]["normal_force"])
    error = abs(summary["energy"]["potential"] - POTENTIAL)
    require(bars["energy"]["potential"] < 30 * error, f"the bar of the potential is {bars['energy']['potential']}, its error {error}")
