import math

from judge import near, require

from lame import FIT, OVERLAP, pressure

FACETS = {"inner": 24, "outer": 16}  # of a quarter


def judge(run):
    exact = pressure(run.summary["options"])
    table = run.table("fit")
    near("mean pressure", run.pair("fit")["normal_force"] / (math.pi / 2 * FIT), exact, relative=0.01)
    near("pressures", table["pressure"], [exact] * len(table["x"]), relative=0.01)
    polygons = run.again("-inner_polygonal", "1", "-outer_polygonal", "1", warns=["coarse_curve", "coarse_mesh"])
    gamma = {name: math.pi / 4 / number for name, number in FACETS.items()}
    overlap = OVERLAP + FIT / 3 * (gamma["outer"] ** 2 - gamma["inner"] ** 2)
    require(overlap > 1.8 * OVERLAP, f"{overlap:.3g} is what polygons overlap by in the mean")
    near("mean pressure of polygons", polygons.pair("fit")["normal_force"] / (math.pi / 2 * FIT), exact * overlap / OVERLAP, relative=0.01)
