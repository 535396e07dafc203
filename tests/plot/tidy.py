"""Words of a picture of solids with many pairs, or with a thin line of contact: none is cut off, none stands on another."""
from canvas import load, require_tidy
from judge import require


def judge(run):
    plot, prefix = load(), str(run.folder / "result")
    figure = plot.draw_solved(prefix, plot.open_summary(prefix, "mm,N,MPa"), None, "von_mises")
    require_tidy(figure, run.summary["scene"]["title"])
    if "foot" in run.summary["pairs"]:  # a line of contact 0.7 wide and 8 long, on a foot of 28
        low, high = next(axes.get_xlim() for axes in figure.axes if axes.get_xlabel() == "x (mm), stretched")
        require(4 < low < 5.2 and 5.9 < high < 7, f"the map of a thin contact ends at {low} and {high}")
