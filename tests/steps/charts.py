"""mortise-plot draws the chart of load steps beside the picture, mortise-report has it; a new run removes the old chart."""
import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import sys

from matplotlib.figure import Figure

from judge import NAME, require, same

PLOT = pathlib.Path(__file__).resolve().parents[2] / "src" / "plot"


def companion(name, folder):
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run([sys.executable, "-B", PLOT / name, NAME], cwd=folder, env=environment, capture_output=True, text=True, check=False)
    same(f"exit code of {name}: {done.stderr}", done.returncode, 0)


def margin_of_constant():
    """Share of the axis above a line of numbers that differ in the last digits alone."""
    loader = importlib.machinery.SourceFileLoader("steps_chart", str(PLOT / "mortise-plot-steps"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    axes = Figure().add_subplot()
    module.draw_panel(axes, [1, 2], {"floor": [0.6, 0.6 + 1e-12]}, [], "t", "force")
    return 1 - 0.6 / axes.get_ylim()[1]


def judge(run):
    require(margin_of_constant() > 0.03, "a constant force lies on the frame")
    chart = run.folder / f"{NAME}_steps.png"
    companion("mortise-plot", run.folder)
    require(chart.read_bytes().startswith(b"\x89PNG"), "there is no chart")
    companion("mortise-report", run.folder)
    page = (run.folder / f"{NAME}.html").read_text()
    require("<h2>Load steps</h2>" in page and page.count('<th scope="row" class="n"><data value="0.5">') >= 1, "the report has no steps")
    subprocess.run([*run.command, "-load_steps", "1"], cwd=run.folder, capture_output=True, check=True)
    require(not chart.exists(), "the chart of the earlier run is still there")
