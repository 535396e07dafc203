"""A wedge that is let go, with too little friction to stay in its groove. It springs out, and nothing presses any more, whatever its way was."""
from judge import near, require


def judge(run):
    for other in (run, run.again("-flank_friction", "0.05", name="less")):
        pressed, free = (step["pairs"]["flank"] for step in other.summary["steps"])
        near("force", free["normal_force"], 0, absolute=1e-12 * pressed["normal_force"])
        require("estimated error: larger than the solution" in other.stdout, other.stdout)
