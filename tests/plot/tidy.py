"""Words of a picture of solids with many pairs, or with a thin line of contact: none is cut off, none stands on another. A cut leaves the names of
the bodies that it leaves."""
from canvas import load, require_tidy, words_of
from judge import require, same


def judge(run):
    plot, prefix = load(), str(run.folder / "result")
    figure = plot.draw_solved(prefix, plot.open_summary(prefix, "mm,N,MPa"), None, "von_mises")
    require_tidy(figure, run.summary["scene"]["title"])
    if "foot" in run.summary["pairs"]:  # a line of contact 0.7 wide and 8 long, on a foot of 28
        low, high = next(axes.get_xlim() for axes in figure.axes if axes.get_xlabel() == "x (mm), stretched")
        require(4 < low < 5.2 and 5.9 < high < 7, f"the map of a thin contact ends at {low} and {high}")
    if "nut_seat" in run.summary["pairs"] and plot.load("mortise-plot-solid").find_pyvista():  # z = 0 takes away the upper plate and the head
        figure = plot.draw_solved(prefix, plot.open_summary(prefix), 1.0, "von_mises", {"view": None, "cut": "z=0"})
        same("names", sorted({text for text, _ in words_of(figure)} & set(run.summary["scene"]["bodies"])), ["lower", "nut", "shank"])
