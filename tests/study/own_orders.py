"""Bodies that keep orders of their own: one line, named so."""
from judge import require, same
from studies import block, rows, words


def judge(run):
    same("orders", [row["order"] for row in rows(run)], [0, 0, 0])
    same("reference", block(run)["reference"], "own orders, level 2")
    same("orders of the bodies", [body["order"] for body in run.summary["scene"]["bodies"].values()], [1, 2])
    require("own orders" in words(run), "the chart does not name the line")
