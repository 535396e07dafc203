"""3002 multipliers are too many for the dense problem: a warning, and no number."""
from judge import require, same


def judge(run):
    same("inf-sup number", run.pair("joint")["inf_sup"], {"number": None, "condition": None})
    (text,) = [w["text"] for w in run.summary["warnings"] if w["code"] == "inf_sup_unknown"]
    require("3002 multipliers" in text and "-infsup" in text, f"the warning is '{text}'")
