"""A line contact far smaller than the first cells: force, half width and pressure of an independent high-order solution."""
from judge import near, require

FORCE, HALF_WIDTH = 4.254230671455137, 0.0701724608769228


def judge(run):
    pair, bars = run.pair("joint"), run.summary["bars"]["pairs"]["joint"]
    require(run.summary["estimate"]["meshes"][-1]["unknowns"] <= 35000, "too many unknowns")
    near("force", pair["normal_force"], FORCE, absolute=bars["normal_force"])
    near("force", pair["normal_force"], FORCE, relative=1e-5)
    near("half width", pair["extent"]["upper"][0], HALF_WIDTH, absolute=bars["extent"]["upper"][0])
    near("half width by area", pair["area"] / 2, HALF_WIDTH, absolute=bars["area"])
