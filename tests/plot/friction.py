"""Pictures of pairs with friction: tractions and their limit beside the pressure, over the zones that stick and slip; forces of load steps."""
import numpy as np

from canvas import load, require_tidy
from judge import near, require, same


def judge(run):
    plot, prefix = load(), str(run.folder / "result")
    summary = plot.open_summary(prefix, "mm,N,MPa")
    figure = plot.draw_solved(prefix, summary, None, "von_mises")
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.08)  # as the program saves it
    require_tidy(figure, run.summary["scene"]["title"])
    for name in summary["scene"]["pairs"]:
        (axes,) = [axes for axes in figure.axes if axes.get_title().startswith(name + ":")]
        table, lines = run.table(name), {line.get_label(): line for line in axes.lines}
        way = np.sign(table["x"][-1] - table["x"][0])  # sides along x
        traction = way * np.array(table["tangential_traction_x"])
        near(f"{name}: tractions", list(lines["tangential traction, along the arc"].get_ydata()), traction, absolute=1e-9)
        side = 1 if traction.max() > 1e-6 * np.abs(traction).max() else -1
        near(f"{name}: limit", list(lines["limit: 0.15 times the pressure"].get_ydata()), side * 0.15 * np.maximum(table["pressure"], 0), absolute=1e-9)
        require(axes.get_ylim()[0] <= traction.min(), f"{name}: tractions below the graph")
        words = {patch.get_label() for patch in axes.patches} & {"sticks", "slips"}
        same(f"{name}: zones", words, {word for code, word in ((3, "slips"), (4, "sticks")) if code in table["status"]})
    steps = plot.load("mortise-plot-steps").draw(plot, prefix, summary)
    (axes,) = [axes for axes in steps.axes if axes.get_title(loc="left") == "tangential force (N)"]
    forces = {line.get_label(): line.get_ydata() for line in axes.lines}
    near("tip and table together", list(forces["tip"] + forces["table"]), [3000 * step["t"] for step in run.summary["steps"]], absolute=1e-4)
    page = (run.folder / "result.html").read_text()
    require("The spectral radius rho is" in page and "share of the contact that slips" in page, "the page has no table of friction")
