"""A bolted joint in space: statics of its three parts, and the forces of the axisymmetric model (bolted_joint). The rims of the plates'
holes coincide, so no partner ends there. Where cells end at the rim of the head, their other nodes have no pressure."""
import math

from judge import near, require

BOLT, LOAD = 17e3 / 4, 7854 / 4
RIM = 9  # of the head


def plate(body):
    """Options of a plate whose third ring of cells ends at the rim."""
    radius = "(x<3 ? 5.5+3.5*x/3 : 9+16*(x-3)/5)"
    return [f"-{body}_map", f"{radius}*cos(y), {radius}*sin(y), z"]


def judge(run):
    tight, loaded = run.summary["steps"]
    for name in ("seat", "nut_seat", "joint"):
        near(f"{name}, tightened", tight["pairs"][name]["normal_force"], BOLT, relative=1e-9)
    for step, load in ((tight, 0), (loaded, LOAD)):
        force = step["pretension"]["shank"]["force"]
        near("section of the bolt", force, step["pairs"]["seat"]["normal_force"], relative=1e-9)
        near("nut", step["pairs"]["nut_seat"]["normal_force"], force, relative=1e-9)
        near("joint and load", step["pairs"]["joint"]["normal_force"] + load, force, relative=1e-9)
        near("rim of the lower plate", step["reactions"]["lower:right"][2], -load, absolute=1e-7)
    near("bolt, axisymmetric model", 4 * loaded["pretension"]["shank"]["force"], 16940.08, relative=1e-3)
    near("joint, axisymmetric model", 4 * loaded["pairs"]["joint"]["normal_force"], 9086.08, relative=2e-3)
    near("strain, axisymmetric model", loaded["pretension"]["shank"]["strain"], -0.00196956, relative=2e-2)

    rim = run.again(*plate("upper"), *plate("lower"), "-load_steps", "1", name="rim")
    table = rim.table("seat")
    beyond = [i for i, (x, y) in enumerate(zip(table["x"], table["y"])) if math.hypot(x, y) > RIM * (1 + 1e-6)]
    require(beyond and all(table["pressure"][i] == 0 and table["status"][i] == -1 for i in beyond), "there is pressure beyond the rim of the head")
