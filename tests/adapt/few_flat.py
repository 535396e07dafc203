"""The first mesh is as good as asked for, but the largest pressure grows with the second one: the third one tells that it has no limit."""
from judge import require, same


def judge(run):
    estimate, bars = run.summary["estimate"], run.summary["bars"]
    require(estimate["meshes"][1]["energy_norm_relative"] < 0.1, f"{estimate['meshes'][1]}")
    same("meshes", len(estimate["meshes"]), 3)
    same("bars of what grows without limit", (bars["unbounded"], bars["pairs"]["joint"]["max_pressure"]), (["joint"], None))
