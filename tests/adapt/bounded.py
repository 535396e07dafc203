"""Largest pressures with a limit are not said to grow without one while cells are as wide as the contact, or as a rounded edge."""
import math

from judge import Run, near, require, same

HERTZ = 2 * 4.254230671455137 / (math.pi * 0.0701724608769228)  # of the force and half width of parabola.py
EDGE = 77.64  # 10 000 unknowns, cells of a twentieth of the width of the rounded edge in contact; the mesh before has 80.70
ROUNDED = "max(0,abs(x)-0.4)^2/2/0.03-0.01"


def judge(run):
    near("largest pressure", run.pair("joint")["max_pressure"], HERTZ, absolute=run.summary["bars"]["pairs"]["joint"]["max_pressure"])
    for gap, meshes, limit in ((None, 4, HERTZ), (ROUNDED, 7, EDGE), (ROUNDED, 9, EDGE)):
        arguments = run.arguments + ["-adapt", "1e-7", "-adapt_max_meshes", str(meshes)] + (["-joint_obstacle_gap", gap] if gap else [])
        coarse = Run(run.program, run.mpiexec, run.ranks, run.folder / f"{meshes}_meshes", arguments)
        same("exit", coarse.exit, 3)  # by the limit
        bars = coarse.summary["bars"]
        same("pressures without a limit", bars["unbounded"], [])
        near(f"largest pressure of {meshes} meshes", coarse.pair("joint")["max_pressure"], limit, absolute=bars["pairs"]["joint"]["max_pressure"])
    require("growing" not in coarse.stdout, coarse.stdout)
