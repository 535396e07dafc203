"""All of the weight is carried."""
from judge import near


def judge(run):
    reactions = run.summary["reactions"]
    carried = sum(reactions[f"squares:{side}"][1] for side in ("held", "far")) + run.pair("joint")["force"][1]
    near("what carries the squares", carried, 2, relative=1e-9)
