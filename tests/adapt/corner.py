"""A largest pressure at a corner is infinite. Three meshes tell it below a rigid flat punch, by the power of the size of its facets. Below an elastic
one with a right angle, seven do."""
from judge import require, same

MESHES = {"punch": 3, "joint": 7}


def judge(run):
    summary = run.summary
    bars = summary["bars"]
    ((pair, own),) = bars["pairs"].items()
    require(len(summary["estimate"]["meshes"]) == MESHES[pair], f"{summary['estimate']['meshes']}")
    same("bars of what grows without limit", (bars["unbounded"], own["max_pressure"]), ([pair], None))
