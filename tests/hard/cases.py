"""What holds in every hard case, and then what holds in this one: judge(run) of cases/<case>.py, where there is such a file."""
import math
import pathlib
import re

from judge import LONG, load, require, same

HEAD = re.compile(r"^# (hard|must|whence|scene|row|ranks|verdict|exit|says): (.*)$", re.MULTILINE)
AGREE = 1e-8  # of displacements of two solvers, relative to the largest
ROUNDING = 1e-9  # contact that pulls, relative to the strongest force that pushes
CERTIFICATE = 1e-7  # the program's own limit is for iterative solvers, too; where nothing carries a force, roundoff itself is 1e-8 here


def read_head(path):
    """The words of a case about itself: {key: text}; keys that may be left out are filled in."""
    found = HEAD.findall(pathlib.Path(path).read_text(encoding="utf-8"))
    head = {"verdict": "solvable", "exit": "0"}
    for key, text in found:
        head[key] = f"{head[key]} {text}" if key in ("hard", "must", "whence") and key in head else text
    if head["verdict"] == "no_solution":
        head["exit"] = "2"
    return head


def worst(summary):
    """The largest number of the certificate, moments that flat facets on curved sides shift left out."""
    figures = [*summary["solver"]["kkt"].values(), *(value for key, value in summary["solver"]["balance"].items() if key != "pair_moment")]
    return max((figure for figure in figures if figure is not None), default=math.nan)


def judge_sound(run):
    """A solved run: both solvers agree, the certificate holds with room to spare, contact presses and bodies do not overlap."""
    solver = run.summary["solver"]
    check = solver["cross_check"]
    require(check["agree"] and check["displacement_difference"] < AGREE, f"the solvers disagree by {check['displacement_difference']:.3g}")
    require(solver["certified"] and worst(run.summary) <= CERTIFICATE, f"the worst of the certificate is {worst(run.summary):.3g}")
    for name, pair in run.summary["pairs"].items():
        table = run.table(name)
        if 1 not in table["status"]:
            continue  # open, or tied, which may pull
        strongest = max(map(abs, table["force"] if "force" in table else table["pressure"]))
        require(pair["normal_force"] >= -ROUNDING * strongest, f"contact of {name} pulls")
    for row in run.summary["energy"]["strain"].values():
        require(row >= 0, "a negative strain energy")


def judge_refused(run):
    """A scene without a solution: one sentence, the motion and its work, and no figure of a solution."""
    run.require_clean()
    told = [line for line in run.stderr.splitlines() if line.startswith("mortise: no solution: ")]
    require(len(told) == 1 and "nothing resists" in told[0], f"{len(told)} refusals: {run.stderr!r}")
    solvability = run.summary["solvability"]
    require(solvability["motion"] and solvability["work"] > 0, "no motion on which the loads do work")
    require(run.summary["energy"]["potential"] is None, "figures of no solution")


def judge_end(run, head):
    """Exit code, verdict, and what goes with them."""
    same("exit code", run.exit, int(head["exit"]))
    if head["exit"] == "1":
        require(run.stderr.count("mortise: ") == 1, "one sentence for one mistake")
        return
    same("verdict", run.summary["solvability"]["verdict"], head["verdict"])
    if head["exit"] == "0":
        judge_sound(run)
    elif head["exit"] == "2":
        judge_refused(run)
    else:
        run.require_clean()
        require(not run.summary["solver"]["certified"] and "says" in head, "exit code 3 for no reason, or one that is not known")


def judge(run):
    path = pathlib.Path(run.arguments[len(run.arguments) - 1 - run.arguments[::-1].index("-options_file") + 1])
    head = read_head(path)
    judge_end(run, head)
    require(head.get("says", "") in run.stderr, f"nothing says '{head.get('says')}'")
    if head["exit"] == "0":
        run.require_solved()
    for ranks in (2, 4) if LONG and head["exit"] == "0" and "says" not in head else ():
        judge_sound(run.again(ranks=ranks, name=f"np{ranks}"))
    if path.with_suffix(".py").exists():
        load(path.with_suffix(".py"))(run)
