"""A node with parts of its facets on either table serves the first; the second hands its part on."""
from judge import near
from uniform import judge_uniform


def judge(run):
    for order in "12":
        solved = run.again("-order", order, name=f"order{order}")
        judge_uniform(solved, ["first", "second"])
        near("forces", [solved.pair(name)["normal_force"] for name in ("first", "second")], [0.45, 0.55], relative=1e-10)
