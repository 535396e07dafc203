"""Names of axes, components and units in pictures and pages: of -units, of --units in their place, of axisymmetric scenes."""
import html
import re
import subprocess
import sys

from canvas import PLOT, load, require_tidy, words_of
from judge import require, same

AXES = {"axisymmetric": ["radius r", "axis z"], "plane_strain": ["x", "y"], "solid": ["x", "y", "z"]}


def figure_of(run, units=None):
    plot = load()
    summary = plot.open_summary(str(run.folder / "result"), units)
    return plot.draw_solved(str(run.folder / "result"), summary, None, "von_mises")


def judge_picture(run, units, length, stress, force):
    figure = figure_of(run, units)
    words = [text for text, _ in words_of(figure)]
    for name in AXES[run.summary["scene"]["model"]]:
        require(f"{name} ({length})" in words, f"no axis is called {name} ({length}): {words}")
    require(any(word.startswith(f"von Mises stress ({stress})") for word in words), f"the stress has no unit {stress}: {words}")
    require(f"contact pressure ({stress})" in words, f"the pressure has no unit {stress}: {words}")
    require(any(re.search(rf"normal force [\d.e+]+ {re.escape(force)}$", word) for word in words), f"the force has no unit {force}: {words}")
    require_tidy(figure, f"units {units}")


def judge_page(run, length, force, stress):
    text = html.unescape(re.sub(r"<[^>]*>", "", (run.folder / "result.html").read_text(encoding="utf-8")))
    names = ["r", "z"] if run.summary["scene"]["model"] == "axisymmetric" else ["x", "y", "z"][:run.summary["scene"]["dimension"]]
    wanted = [f"normal force ({force})", f"area ({length}²)", f"largest pressure ({stress})", f"energy ({force} {length})"]
    wanted += [f"force {name} ({force})" for name in names]
    if run.summary["probes"]:
        wanted += [f"displacement {name} ({length})" for name in names]
        wanted += [f"stress {part} ({stress})" for part in (["rr", "zz", "θθ", "rz"] if names[0] == "r" else ["xx", "yy", "zz", "xy"])]
    for words in wanted:
        require(words in text, f"the page does not say {words}")


def judge_mistakes(run):
    for units, says in (("mm,N", "2 names given, 3 wanted"), ("mm,,MPa", "empty item"), ("mm,N,MPa of this joint", "at most 15 bytes")):
        for name in ("mortise-plot", "mortise-report"):
            done = subprocess.run([sys.executable, PLOT / name, run.folder / "result", "-o", run.folder / "none", "--units", units],
                                  capture_output=True, text=True, check=False)
            same(f"exit code of {name} --units {units}", done.returncode, 1)
            require(done.stderr.startswith(f"{name}: --units {units}: ") and says in done.stderr and done.stderr.count("\n") == 1, done.stderr)


def judge(run):
    units = run.summary["scene"]["units"]
    same("units", units, dict(zip(("length", "force", "stress"), run.arguments[run.arguments.index("-units") + 1].split(","))))
    judge_picture(run, None, **units)
    judge_picture(run, "µm,cN,t/in^2", "µm", "t/in^2", "cN")
    judge_page(run, **units)
    if len(units["length"]) == 1:  # of one scene: they have no scene in them
        judge_mistakes(run)
    fourth = run.again("-units", "a,b,c,K", "-report", "0", name="fourth")  # names that nobody knows are taken as they are
    same("unknown units, and that of temperature", fourth.summary["scene"]["units"], {"length": "a", "force": "b", "stress": "c", "temperature": "K"})
