"""A rigid roller across a block in plane strain: every pressure is that of the plane scene, and they come near those of Hertz' line."""
import math
import pathlib

import numpy as np

from judge import Run, near

MODULUS, RADIUS, WIDTH = 1000 / (1 - 0.3**2), 5, 0.5
PLANE = pathlib.Path(__file__).with_name("roller_plane.opts")


def judge(run):
    plane = Run(run.program, run.mpiexec, 1, run.folder / "plane", ["-options_file", str(PLANE)])
    plane.require_solved()
    expected = dict(zip(np.round(plane.table("line")["x"], 9), plane.table("line")["pressure"]))
    table = run.table("line")
    near("pressures", table["pressure"], [expected[x] for x in np.round(table["x"], 9)], relative=1e-9)
    near("force", run.pair("line")["normal_force"], WIDTH * plane.pair("line")["normal_force"], relative=1e-9)
    force = 2 * run.pair("line")["normal_force"] / WIDTH
    half = math.sqrt(4 * force * RADIUS / (math.pi * MODULUS))
    near("largest pressure", run.pair("line")["max_pressure"], 2 * force / (math.pi * half), relative=1e-2)
