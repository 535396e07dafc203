"""The right half of a line contact, from cells of 14 half widths. Force to 1e-6 and half width to 2e-3 of an independent high-order solution."""
from judge import near, require
from parabola import FORCE, HALF_WIDTH


def judge(run):
    pair, bars = run.pair("joint"), run.summary["bars"]["pairs"]["joint"]
    require(run.summary["estimate"]["meshes"][-1]["unknowns"] <= 35000, "too many unknowns")
    near("force", pair["normal_force"], FORCE / 2, relative=1e-6)
    near("force", pair["normal_force"], FORCE / 2, absolute=bars["normal_force"])
    near("half width", pair["extent"]["upper"][0], HALF_WIDTH, relative=2e-3)
    near("half width", pair["extent"]["upper"][0], HALF_WIDTH, absolute=bars["extent"]["upper"][0])
