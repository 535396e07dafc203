"""A bolted joint in space: statics of its three parts, and the forces of the axisymmetric model (bolted_joint)."""
from judge import near

BOLT, LOAD = 17e3 / 4, 7854 / 4


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
