"""Rigid motions of solids in pictures: arrows where bodies go away, an arrow for each motion that is free."""
from matplotlib import pyplot as plt
from matplotlib.patches import FancyArrowPatch

from arrows import load, refuse, require_picture
from judge import same


def judge(run):
    require_picture(refuse(run, "lifted", "-b5_body_force", "0,0,1"))
    plot, solid = load("mortise-plot"), load("mortise-plot-solid")
    fields = plot.read_fields(str(run.folder / "result"))
    figure, axes = plt.subplots()
    view = solid.View((1, -2, 1))
    plot.draw_free(axes, run.summary, fields, 1.0, view.flat)
    same("free motions that are drawn", len([patch for patch in axes.patches if isinstance(patch, FancyArrowPatch)]), 15)
    plt.close(figure)
