"""X5: shrink fit of two rings (Lame), interference and inner pressure, on refined maps."""
from judge import near, require

FIT, BORE, BOTH = 0.192374956278419, 0.1603124635653489, 0.35268741984376784  # pressure at the joint
U_BORE, U_RIM = -0.00016031246356534919, 0.0005941471376938324


def mean_pressure(run):
    """normal force over the length of the quarter arc of radius 2."""
    return run.pair("fit")["normal_force"] / run.pair("fit")["area"]


def judge(run):
    near("pressure of the fit", mean_pressure(run), FIT, relative=1e-3)
    near("bore", run.probe("bore")["displacement"][0], U_BORE, relative=2e-3)
    near("rim", run.probe("rim")["displacement"][0], U_RIM, relative=2e-3)
    table = run.table("fit")
    near("pressure along the joint", table["pressure"], [FIT] * len(table["pressure"]), relative=5e-3)
    near("bore under pressure", mean_pressure(run.again("-fit_gap", "0", "-inner_bc_pressure", "left", "-inner_bc_pressure_left", "2", name="bore")), BORE, relative=1e-3)
    near("both", mean_pressure(run.again("-inner_bc_pressure", "left", "-inner_bc_pressure_left", "2", name="both")), BOTH, relative=1e-3)
    finer = run.again("-dm_refine", "1", name="finer")
    ratio = (mean_pressure(run) - FIT) / (mean_pressure(finer) - FIT)
    require(3.4 < ratio < 4.6, f"halving the mesh divides the error of the pressure by {ratio:.2f} instead of 4")
