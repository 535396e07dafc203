"""GRECO on adapted meshes: four digits of the limits of fine meshes, bars that hold them, and the same meshes on every number of ranks."""
from judge import near, require

SLIP = {0: 2.8603, 1.25: 2.7226, 5: 2.2868, 7.5: 1.98076, 11.25: 1.54140}  # u_x in 1e-5 m at x in mm
NAMES = ("tangential_force", "max_slip", "dissipation", "normal_force", "area")


def between(points, x):
    """Linear between the two neighbours."""
    left, right = max(p for p in points if p[0] <= x), min(p for p in points if p[0] >= x)
    if left[0] == right[0]:
        return left[1]
    return left[1] + (right[1] - left[1]) * (x - left[0]) / (right[0] - left[0])


def judge(run):
    table = run.table("floor")
    points = sorted(zip((1e3 * x for x in table["x"]), (1e5 * s for s in table["slip_x"])))
    for x, slip in SLIP.items():
        near(f"slip at x = {x} mm", between(points, x), slip, relative=5e-5)
    meshes = run.summary["estimate"]["meshes"]
    require(meshes[-1]["unknowns"] < 12000, f"{meshes[-1]['unknowns']} unknowns")
    require(all(mesh["iterations"] <= 4 for mesh in meshes[1:]), "more than four Newton steps from the mesh before")
    require(run.summary["estimate"]["potential"]["value"] is None, "there is no limit of the potential with friction")
    bars, floor = run.summary["bars"]["pairs"]["floor"], run.pair("floor")
    if run.ranks == 1:
        finer = run.again("-adapt", "1.5e-4", name="finer").pair("floor")
        for name in NAMES:
            value, bar, true = (x[0] if isinstance(x, list) else x for x in (floor[name], bars[name], finer[name]))
            require(abs(value - true) <= bar, f"{name} {value} +- {bar}, finer {true}")
    else:
        alone = run.again(ranks=1, name="alone").summary
        for name in NAMES:
            near(f"{name}, the same on one rank", floor[name], alone["pairs"]["floor"][name], relative=1e-9)
            near(f"bar of {name}, the same on one rank", bars[name], alone["bars"]["pairs"]["floor"][name], relative=1e-6)
