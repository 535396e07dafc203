"""The map of a pair with friction in space, of more nodes than are marked where there is none: the nodes that slip, and arrows of the traction, here along circles."""
import numpy as np
from matplotlib.quiver import Quiver

from canvas import load
from judge import near, require


def judge(run):
    plot, prefix = load(), str(run.folder / "result")
    figure = plot.draw_solved(prefix, plot.open_summary(prefix, "mm,N,MPa"), None, "von_mises")
    (axes,) = [axes for axes in figure.axes if axes.get_title().startswith("disc:")]
    (slips,) = [drawn for drawn in axes.collections if drawn.get_label() == "slips"]
    near("nodes that slip", len(slips.get_offsets()), run.pair("disc")["active_nodes"])
    (arrows,) = [drawn for drawn in axes.collections if isinstance(drawn, Quiver)]
    require(200 < arrows.N <= 400, f"{arrows.N} arrows")
    turn = (arrows.X * arrows.V - arrows.Y * arrows.U) / np.hypot(arrows.X, arrows.Y) / np.hypot(arrows.U, arrows.V)
    near("sine of the angle between arrow and radius", list(np.abs(turn)), [1.0] * arrows.N, absolute=2e-2)
    require(abs(turn.sum()) > 0.99 * arrows.N, "arrows point both ways round")
