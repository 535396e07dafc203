"""Rigid motions in files, pictures and pages: that of a scene without a solution, and free ones."""
import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import FancyArrowPatch
from matplotlib.quiver import Quiver

from judge import Run, near, require, same

PLOT = pathlib.Path(__file__).parents[2] / "src" / "plot"
TIPPED = ["-lower_dm_plex_box_upper", "0.375,0", "-upper_bc_traction_top", "0,0"]
CENTRE = np.array([0.375, 0])  # the end of the block below
RING = ["-model", "axisymmetric", "-lower_dm_plex_box_lower", "0,-1", "-upper_dm_plex_box_lower", "0.5,0", "-upper_bc_traction_top", "0,2"]


def load(name):
    """A program of options/ as a module."""
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader(name.replace("-", "_"), str(PLOT / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def refuse(run, name, *options):
    case = Run(run.program, run.mpiexec, run.ranks, run.folder / name, run.arguments + list(options))
    same(f"exit code of {name}", case.exit, 2)
    case.require_clean()
    return case


def require_picture(case):
    done = subprocess.run([PLOT / "mortise-plot", case.folder / "result"], capture_output=True, text=True, check=False)
    same(f"what mortise-plot says of {case.folder.name}", (done.returncode, done.stderr), (0, ""))
    require((case.folder / "result.png").stat().st_size > 0, f"{case.folder.name}: no picture")


def judge_file(case):
    """The motion at every node is a turn of the upper block by one radian about the end of the lower one. Nothing else is told."""
    with case.fields() as file:
        same("fields", sorted(file), ["body", "cells", "motion", "points"])
        points, motion, cells, body = (file[key][()] for key in ("points", "motion", "cells", "body"))
    upper = np.unique(cells[body == 0])
    arm = points[upper, :2] - CENTRE
    near("motion", motion[upper, :2].ravel(), np.column_stack([arm[:, 1], -arm[:, 0]]).ravel(), absolute=1e-9)
    near("motion of the block below", motion[np.unique(cells[body == 1])].ravel(), np.zeros(3 * len(np.unique(cells[body == 1]))))


def judge_arrows(case, plot):
    """Arrows stand inside the block that moves, across the way to the point that it turns about, clockwise, and do not touch each other."""
    arrows = load("mortise-plot-motion")
    fields = arrows.read_motion(plot, str(case.folder / "result"))
    figure, axes = plt.subplots()
    arrows.draw_motion(plot, axes, case.summary, fields)
    quiver = next(part for part in axes.collections if isinstance(part, Quiver))
    places, ways = quiver.XY, np.column_stack([quiver.U, quiver.V])
    require(30 < len(places) < 150, f"{len(places)} arrows")
    require((places > 0).all() and (places < 1).all(), "an arrow beside the block")
    arm, length = places - CENTRE, np.linalg.norm(ways, axis=1)
    near("arrows", (ways / length[:, None]).ravel(), (np.column_stack([arm[:, 1], -arm[:, 0]]) / np.linalg.norm(arm, axis=1)[:, None]).ravel(), absolute=1e-6)
    apart = np.linalg.norm(places[:, None] - places[None], axis=2)[~np.eye(len(places), dtype=bool)].min()
    require(length.max() < apart, "arrows touch each other")
    same("points that something turns about", len(axes.lines), 1)
    near("the point that it turns about", axes.lines[0].get_xydata()[0], CENTRE, absolute=1e-9)
    plt.close(figure)


def judge_free(run, plot, bodies):
    """One arrow with two heads for each free motion of each body."""
    figure, axes = plt.subplots()
    plot.draw_free(axes, run.summary, plot.read_fields(str(run.folder / "result")), 1.0)
    patches = [patch for patch in axes.patches if isinstance(patch, FancyArrowPatch)]
    same("free motions that are drawn", len(patches), bodies)
    plt.close(figure)


def judge(run):
    plot = load("mortise-plot")
    case = refuse(run, "tipped", *TIPPED, "-report", "1")
    require_picture(case)
    judge_file(case)
    judge_arrows(case, plot)
    page = (case.folder / "result.html").read_text(encoding="utf-8")
    require("tips about (0.375, 0)" in page and "data:image/svg+xml" in page and "Nothing was solved" in page, "the page tells nothing of the motion")
    vtu = refuse(run, "both_formats", *TIPPED, "-output_format", "xdmf,vtu")
    require('Name="motion"' in (vtu.folder / "result.vtu").read_text(encoding="utf-8"), "no motion in the VTU file")
    ring = refuse(run, "ring", *RING)
    require_picture(ring)
    near("work on the ring", ring.summary["solvability"]["work"], np.pi * (1 - 0.5**2) * (2 - 1), relative=1e-9)
    judge_free(run, plot, 1)
    judge_free(run.again("-upper_body_force", "0,0", "-upper_bc_traction_top", "0,0", name="idle"), plot, 3)
