"""A body a million times stiffer, once nonmortar and once mortar: the same numbers within the bars, and estimates that agree."""
from judge import near


def judge(run):
    other = run.again("-joint_nonmortar", "lower:top", "-joint_mortar", "upper:bottom")
    for key in ("normal_force", "area"):
        near(key, run.pair("joint")[key], other.pair("joint")[key],
             absolute=run.summary["bars"]["pairs"]["joint"][key] + other.summary["bars"]["pairs"]["joint"][key])
    limits = [one.summary["estimate"]["potential"] for one in (run, other)]
    near("potential", limits[0]["value"], limits[1]["value"], absolute=limits[0]["bar"] + limits[1]["bar"])
