"""A uniform state below the limit of friction is exact at every node, on meshes that do not match."""
from judge import near, same


def judge(run):
    table = run.table("joint")
    near("pressure", table["pressure"], [1] * len(table["x"]), absolute=1e-11)
    near("tangential traction", table["tangential_traction_x"], [-0.297] * len(table["x"]), absolute=1e-11)
    axes = "xyz" if "z" in table else "xy"
    for axis in axes:
        near(f"slip in {axis}", table[f"slip_{axis}"], [0] * len(table["x"]), absolute=1e-14)
    same("status", set(table["status"]), {4})
    same("slipping, sticking", [run.summary["solver"]["friction"][key] for key in ("slipping", "sticking")], [0, len(table["x"])])
    normal = run.pair("joint")["normal_force"]
    near("normal force", normal, 1, relative=1e-12)
    near("tangential force", run.pair("joint")["tangential_force"], [-0.297] + [0] * (len(axes) - 1), absolute=1e-11)
