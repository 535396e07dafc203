"""Maps of pressures: a peak at one node does not take all colours, and the legend tells it; a map without one ends at its largest pressure."""
import numpy as np
from matplotlib import pyplot as plt

from canvas import load, require_tidy, words_of
from judge import near, require


def judge(run):
    plot, prefix = load(), str(run.folder / "result")
    summary, solid = plot.open_summary(prefix, "mm,N,MPa"), plot.load("mortise-plot-solid")
    surface = plot.read_surface(prefix, "joint")
    near("end of the colours of one pressure", solid.pressure_limit(plot, surface, 1.0), 1e6, relative=1e-9)
    corner = np.argmin(np.linalg.norm(surface["points"], axis=1))
    surface["pressure"] = surface["pressure"].copy()
    surface["pressure"][corner] *= 5
    near("end of the colours beside a peak", solid.pressure_limit(plot, surface, 1.0), 1e6, relative=1e-9)
    figure, axes = plt.subplots(figsize=(5, 4), layout="constrained")
    solid.draw_pressure(figure, axes, plot, "joint", surface, summary, 1.0)
    words = [text for text, _ in words_of(figure)]
    require("contact pressure (MPa) (largest 5e+06)" in words, f"the legend does not tell the peak: {words}")
    require_tidy(figure, "a map with a peak")

    figure = plot.draw_solved(prefix, summary, None, "von_mises")
    for name in summary["scene"]["bodies"]:
        require(name in [text for text, _ in words_of(figure)], f"the picture does not name {name}")
    require_tidy(figure, "the whole picture")
    figure, axes = plt.subplots(figsize=(3, 4), layout="constrained")
    axes.set_title("floor: 119 of 1218 nodes in contact, normal force 143.681 N", fontsize=10)
    plot.break_titles(figure)
    require_tidy(figure, "a long title")
