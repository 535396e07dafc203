"""X5: shrink fit of two spherical shells (Lame): interference, inner pressure, order of the error."""
import math

from judge import near, require

FIT, BORE, BOTH = 0.45000518439152526, 0.09642968236961255, 0.5464348667611377  # pressure at the joint
U_BORE, U_RIM = -0.00019285936473922513, 0.00037935920920747937
FORCE = 22.619727701787777  # 4 pi R^2 p, of which the upper half carries one half, and half of that along the axis
PRESSED = ["-inner_bc_pressure", "left", "-inner_bc_pressure_left", "2"]


def mean_pressure(run):
    """normal force over the area of the half sphere of radius 2."""
    return run.pair("fit")["normal_force"] / run.pair("fit")["area"]


def pressures(run):
    """Of nodes that are more than a sixth of the radius away from the axis, and of the one on it."""
    table = run.table("fit")
    rows = sorted(zip(table["x"], table["pressure"]))
    require(rows[0][0] == 0, "no node is on the axis")
    return [p for x, p in rows if x > 2 / 6], rows[0][1]


def judge(run):
    near("mean pressure", mean_pressure(run), FIT, relative=1e-3)
    away, on_axis = pressures(run)
    near("pressure along the joint", away, [FIT] * len(away), relative=1e-3)
    near("normal force", run.pair("fit")["normal_force"], FORCE / 2, relative=1e-3)
    near("force", run.pair("fit")["force"], [0, FORCE / 4], relative=1e-3)
    near("bore", run.probe("bore")["displacement"][0], U_BORE, relative=1e-3)
    near("rim, on the axis", run.probe("rim")["displacement"], [0, U_RIM], relative=3e-3)
    near("bore under pressure", mean_pressure(run.again("-fit_gap", "0", *PRESSED, name="bore")), BORE, relative=1e-3)
    near("both", mean_pressure(run.again(*PRESSED, name="both")), BOTH, relative=1e-3)
    finer = run.again("-dm_refine", "1", name="finer")
    ratio = (mean_pressure(run) - FIT) / (mean_pressure(finer) - FIT)
    require(3.4 < ratio < 4.6, f"halving the mesh divides the error of the pressure by {ratio:.2f} instead of 4")
    near("pressure on the axis, of first order only", on_axis, FIT, relative=2e-2)
    ratio = (on_axis - FIT) / (pressures(finer)[1] - FIT)
    require(1.8 < ratio < 2.5, f"halving the mesh divides the error on the axis by {ratio:.2f} instead of 2")
    quadratic = run.again("-order", "2", name="quadratic")
    near("mean pressure of order 2", mean_pressure(quadratic), FIT, relative=1e-5)
    near("its pressure along the joint", quadratic.table("fit")["pressure"], [FIT] * len(quadratic.table("fit")["pressure"]), relative=5e-4)
    near("half of the area", quadratic.pair("fit")["area"], 2 * math.pi * 2**2, relative=1e-5)
