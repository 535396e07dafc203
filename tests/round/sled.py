"""A sled on two round feet, on a floor without friction: any push sets it going, and none at all lets it stand."""
from judge import LONG
from scenes import Findings, Scene, judge_force, require

FOOT = "0.1*(1+cos(pi*x/0.75))"  # two humps upside down, lowest at x = -0.75 and 0.75
PUSHES = (1e-6, 1e-4, 1e-2, 0.05, 0.5)


def sled_scene(order, push, floor):
    scene = Scene(order=order)
    scene.block("sled", (31, 5), (-1.5, 0), (1.5, 1), young=1000, force=(push, -1), map=f"x, y+(1-y)*{FOOT.replace('pi', '3.14159265358979323846')}")
    if floor == "plane":
        scene.plane("floor", "sled", (0, 0), (0, 1), side="bottom")
    else:
        scene.block("base", (60, 4), (-2.5, -0.5), (2.5, 0), young=1000, bc_displacement="bottom", bc_displacement_bottom="0,0")
        scene.joint("floor", "sled:bottom", "base:top", swapped=floor == "floor nonmortar")
    return scene


def judge_still(run, name, order, floor):
    done = sled_scene(order, 0, floor).solve(run, name)
    judge_force(name, done, "floor", [0, 2.7], 1e-9, swapped=floor == "floor nonmortar")  # also of the mesh: the humps are two periods of a cosine


def judge_pushed(run, name, order, floor, push):
    refused = sled_scene(order, push, floor).solve(run, f"{name}_{push}", exits=(2,))
    told = refused.summary["solvability"]
    require(told["verdict"] == "no_solution" and told["work"] > 0, f"{name}: pushed by {push}: {told['sentence']}, work {told['work']}")
    require(f"along ({'' if push > 0 else '-'}1, 0)" in told["sentence"], f"{name}: pushed by {push}: {told['sentence']}")


def judge(run):
    found = Findings()
    for floor in ("plane", "sled nonmortar", "floor nonmortar"):
        for order in (1, 2):
            name = f"{floor}_{order}".replace(" ", "_")
            with found.case():
                judge_still(run, name, order, floor)
            for push in PUSHES if LONG or order == 2 else PUSHES[:1]:
                for sign in (1, -1) if LONG or push == 0.05 else (1,):
                    with found.case():
                        judge_pushed(run, name, order, floor, sign * push)
    found.end()
