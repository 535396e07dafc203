"""A file name that begins outside ASCII opens in VTK, whose reader of XDMF wants something of ASCII before it."""
import os
import subprocess

import numpy as np

from canvas import load
from judge import ALONE, CHECKS, require, same


def judge(run):
    done = subprocess.run([run.program, *CHECKS, "-output", "änderung", *run.arguments], cwd=run.folder, env=os.environ | ALONE,
                          capture_output=True, text=True, check=False)
    same("exit code", done.returncode, 0)
    text = (run.folder / "änderung.xdmf").read_text(encoding="utf-8")
    require(">./änderung.h5:/points<" in text and ">änderung.h5" not in text, "the file is not named behind ./")
    require(">result.h5:/points<" in (run.folder / "result.xdmf").read_text(encoding="utf-8"), "a plain name is not written as it is")
    pyvista = load("mortise-plot-solid").find_pyvista()
    if pyvista:
        grid = pyvista.read(run.folder / "änderung.xdmf")
        with run.fields() as file:
            require(np.array_equal(np.array(grid.points), file["points"][()]), "VTK reads other points")
