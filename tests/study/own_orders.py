"""Bodies that keep orders of their own: one line, named so. A title that XML would misread. The summary alone, for programs."""
import json

from judge import require, same
from studies import block, rows, words


def judge(run):
    same("orders", [row["order"] for row in rows(run)], [0, 0, 0])
    same("reference", block(run)["reference"], "own orders, level 2")
    same("orders of the bodies", [body["order"] for body in run.summary["scene"]["bodies"].values()], [1, 2])
    require("own orders" in words(run), "the chart does not name the line")
    require('"Wood" & <glue>' in words(run), "the chart does not have the title")

    silent = run.again("-summary", "-", name="silent")
    same("runs in the summary on the terminal", len(json.loads(silent.stdout)["study"]["runs"]), 3)
    same("what is printed with -quiet", run.again("-quiet", name="quiet").stdout, "")
