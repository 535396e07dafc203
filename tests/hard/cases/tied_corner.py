"""One state in all three."""
from uniform import judge_uniform


def judge(run):
    for order in "12":
        judge_uniform(run.again("-order", order, name=f"order{order}"), ["foot", "joint"])
