"""X5 in space: shrink fit of two spherical shells (Lame), order of the error, tetrahedra, cells of first order."""
import math

from judge import near, require

FIT, BORE = 0.45000518439152526, 0.09642968236961255
U_BORE, U_RIM = -0.00019285936473922513, 0.00037935920920747937
PRESSED = ["-fit_gap", "0", "-inner_bc_pressure", "bottom", "-inner_bc_pressure_bottom", "2"]
PART = 24  # of the sphere


def mean_pressure(run):
    return run.pair("fit")["normal_force"] / run.pair("fit")["area"]


def judge(run):
    near("mean pressure", mean_pressure(run), FIT, relative=1e-3)
    near("pressure along the joint", run.table("fit")["pressure"], [FIT] * len(run.table("fit")["pressure"]), relative=1e-2)
    near("area", run.pair("fit")["area"], 4 * math.pi * 2**2 / PART, relative=1e-3)
    near("bore", run.probe("bore")["displacement"], [0, 0, U_BORE], relative=1e-3)
    near("rim", run.probe("rim")["displacement"], [0, 0, U_RIM], relative=1e-3)
    near("bore under pressure", mean_pressure(run.again(*PRESSED, name="bore")), BORE, relative=2e-3)
    fine = ["-outer_dm_plex_box_faces", "6,6,5", "-inner_dm_plex_box_faces", "5,5,4"]
    finer = run.again(*fine, name="finer")
    ratio = (mean_pressure(run) - FIT) / (mean_pressure(finer) - FIT)
    require(ratio > 2.5, f"cells two thirds as large divide the error of the pressure by {ratio:.2f} only")
    simplices = ["-outer_dm_plex_simplex", "1", "-inner_dm_plex_simplex", "1"]
    coarse, less = (mean_pressure(run.again(*simplices, *mesh, name="tetrahedra")) - FIT for mesh in ([], fine))
    require(abs(less) < 0.6 * abs(coarse) < 0.6 * 5e-3 * FIT, f"tetrahedra are off by {coarse / FIT:.2g} and {less / FIT:.2g}")
    near("mean pressure of order 1", mean_pressure(run.again("-order", "1", *fine, name="linear")), FIT, relative=1.5e-2)
