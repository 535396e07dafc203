"""A largest pressure at the corner of a rigid flat punch is infinite: three meshes tell it by the power of the size of its facets."""
from judge import require, same


def judge(run):
    summary = run.summary
    require(len(summary["estimate"]["meshes"]) == 3, f"{summary['estimate']['meshes']}")
    bars = summary["bars"]
    same("bars of what grows without limit", (bars["unbounded"], bars["pairs"]["punch"]["max_pressure"]), (["punch"], None))
