"""A thin contact has a detail in the picture of the bodies: around its middle, some widths wide. A wide contact has none."""
import numpy as np

from canvas import load, require_tidy
from judge import near, require, same

TITLE = "around the contact, true to scale"


def details(run):
    plot, prefix = load(), str(run.folder / "result")
    figure = plot.draw_solved(prefix, plot.open_summary(prefix, "mm,N,MPa"), None, "von_mises")
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.08)  # as the program saves it
    require_tidy(figure, run.summary["scene"]["title"])
    return [axes for axes in figure.axes if axes.get_title() == TITLE]


def judge(run):
    (detail,) = details(run)
    (pair,) = run.summary["pairs"].values()
    (low, high), (below, above) = detail.get_xlim(), detail.get_ylim()
    width = pair["extent"]["upper"][0] - pair["extent"]["lower"][0]
    near("middle", (low + high) / 2, 0, absolute=0.02 * width)
    near("size", [high - low, above - below], [3 * width] * 2, relative=0.05)
    table = run.table("joint")
    nodes = np.array(table["status"]) == 1
    require(below < np.array(table["y"])[nodes].min() and np.array(table["y"])[nodes].max() < above, "the contact is not in the detail")
    wide = run.again("-disc_bc_displacement_top", "0,-1.5", name="wide")
    same("details of a wide contact", len(details(wide)), 0)
