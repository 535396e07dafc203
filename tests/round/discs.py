"""A disc under its own weight rests on a plane, however its mesh is turned: the force is the weight, upright, and nothing else.

Statics. By files, polygons and arcs, floor rigid or a block, the disc nonmortar or mortar.
"""
import itertools
import math

import roundmesh
from judge import LONG
from scenes import Findings, Scene, judge_force, require

TURNS = (0, 0.3, 1.1, 2, 3.7, 6)
BEYOND = ("disc nonmortar", 1, 4, 1.1)  # the floor is in reach of one node of a facet, and of the other not: it was marginal
MESHES = ((4, 0.0), (6, 0.2), (9, 0.0))  # layers, unevenness


def disc_scene(folder, floor, order, layers, spread, turned, young=1e5):
    scene = Scene(order=order)
    scene.file("disc", roundmesh.disc(1, layers, order, turned, centre=(0, 1), spread=spread), folder, young=young, force=(0, -1))
    if floor == "plane":
        scene.plane("floor", "disc", (0, 0), (0, 1), side="rim")
    else:
        scene.block("base", (24, 4), (-1.5, -0.5), (1.5, 0), young=3 * young, bc_displacement="bottom", bc_displacement_bottom="0,0")
        scene.joint("floor", "disc:rim", "base:top", swapped=floor == "floor nonmortar")
    return scene


def judge(run):
    found = Findings()
    cases = list(itertools.product(("plane", "disc nonmortar", "floor nonmortar"), (1, 2), MESHES, TURNS))
    for number, (floor, order, (layers, spread), turned) in enumerate(cases):
        if not LONG and number % 6 != number // 6 % 6 and (floor, order, layers, turned) != BEYOND:
            continue  # each floor, order and mesh, turned by another angle
        name = f"{floor}_{order}_{layers}_{turned}".replace(" ", "_")
        scene = disc_scene(run.folder / "meshes" / name, floor, order, layers, spread, turned)
        for more in ((), ("-snes_type", "vinewtonrsls")) if LONG else ((),):
            with found.case():
                done = scene.solve(run, name, *more)
                judge_force(name, done, "floor", [0, scene.measure["disc"]], 1e-9, swapped=floor == "floor nonmortar")
                require(done.summary["solvability"]["verdict"] != "marginal", f"{name}: marginal")
    three = disc_scene(run.folder / "meshes" / "three", "plane", 1, 6, 0, math.pi / 7)
    with found.case():
        judge_force("three ranks", three.solve(run, "three", ranks=3), "floor", [0, three.measure["disc"]], 1e-9)
    found.end()
