"""The first mesh is as good as asked for, and one more tells the bars: they hold the exact solution."""
from judge import near, same


def judge(run):
    pair, bars = run.pair("joint"), run.summary["bars"]["pairs"]["joint"]
    same("meshes", len(run.summary["estimate"]["meshes"]), 2)
    near("force", pair["normal_force"], 2e6 / 3, absolute=bars["normal_force"])
    near("largest pressure", pair["max_pressure"], 1e6, absolute=bars["max_pressure"])
    near("end of contact", pair["extent"]["upper"][0], 0, absolute=bars["extent"]["upper"][0])
