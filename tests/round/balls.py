"""Balls in space: one on a plane, and four as a pyramid in a tray of planes, with the forces of statics.

The pyramid: three balls on the floor, each against its wall, and one on top of them. Centres are the corners of a tetrahedron of edge
2 R, so that lines of centres are inclined by cos = sqrt(2/3) against the vertical. Each carries W / (3 sqrt(2/3)) = W / sqrt(6). Each
wall carries the horizontal part of it, W / sqrt(18). Each lower ball stands on 4 W / 3.
"""
import math

import numpy as np
from judge import LONG
from scenes import Findings, Scene, judge_force, turn

TURNED = (1, 2, 3, 0.7)  # no node is lowest


def ball_on_plane(order, young, floor="plane", cells=4):
    scene = Scene(dim=3, order=order)
    scene.roller("ball", 1, cells, (0, 0, 1), turned=TURNED, young=young, force=(0, 0, -1))
    if floor == "plane":
        scene.plane("floor", "ball", (0, 0, 0), (0, 0, 1))
    else:
        scene.block("base", (6, 6, 2), (-0.8, -0.8, -0.4), (0.8, 0.8, 0), young=young, bc_displacement="bottom", bc_displacement_bottom="0,0,0")
        scene.joint("floor", "ball:bottom+left+right+top+front+back", "base:top", swapped=floor == "floor nonmortar")
    return scene


def pyramid(order, cells, swapped):
    scene = Scene(dim=3, order=order)
    out = [np.array([math.cos(a), math.sin(a), 0]) for a in (0.4, 0.4 + 2 * math.pi / 3, 0.4 + 4 * math.pi / 3)]
    sides = "bottom+left+right+top+front+back"
    # the top ball stands on a corner of its cube, so that middles of edges are where it touches: nodes of an even number of cells
    down = np.cross([1, 1, 1], [0, 0, -1])
    standing = turn((*down, math.acos(-1 / math.sqrt(3))))
    edge = standing @ [1, 1, 0] / math.sqrt(2)
    about = turn((0, 0, 1, 0.4 - math.atan2(edge[1], edge[0])))
    scene.roller("top", 1, cells, (0, 0, 1 + math.sqrt(8 / 3)), turned=about @ standing, young=1e6, force=(0, 0, -1))
    expected = {}
    for k, direction in enumerate(out):
        centre = 2 / math.sqrt(3) * direction + [0, 0, 1]
        # the same mesh, turned with its place: three balls alike
        scene.roller(f"b{k}", 1, cells, centre, turned=(0, 0, 1, 0.4 + 2 * math.pi / 3 * k), young=1e6, force=(0, 0, -1))
        scene.plane(f"floor{k}", f"b{k}", (0, 0, 0), (0, 0, 1))
        scene.plane(f"wall{k}", f"b{k}", centre + direction, -direction)
        scene.joint(f"joint{k}", f"top:{sides}", f"b{k}:{sides}", swapped=swapped)
        line = np.array([0, 0, math.sqrt(2 / 3)]) - direction / math.sqrt(3)  # from b to top
        expected |= {f"floor{k}": (0, 0, 4 / 3), f"wall{k}": -direction / math.sqrt(18), f"joint{k}": line / math.sqrt(6)}
    return scene, expected


def judge_pyramid(run, order, cells, swapped):
    scene, expected = pyramid(order, cells, swapped)
    name = f"pyramid_{order}_{cells}{'_swapped' if swapped else ''}"
    done = scene.solve(run, name)
    for pair, direction in expected.items():
        judge_force(name, done, pair, scene.measure["top"] * np.array(direction), 1e-6, swapped=swapped and pair.startswith("joint"))


def judge(run):
    found = Findings()
    for order in (1, 2):
        for young in (1e3, 1e5, 1e7, 1e9) if LONG else (1e3, 1e9):
            for floor in ("plane", "ball nonmortar", "floor nonmortar") if LONG or order == 1 else ("plane",):
                name = f"ball_{floor}_{order}_{young:g}".replace(" ", "_")
                scene = ball_on_plane(order, young, floor)
                with found.case():  # K u is rounded by 1e-16 of E times the turn from node to node
                    judge_force(name, scene.solve(run, name), "floor", (0, 0, scene.measure["ball"]), 1e-9 + 1e-15 * young, swapped=floor == "floor nonmortar")
    for order in (1, 2) if LONG else (1,):
        for swapped in (False, True):
            with found.case():
                judge_pyramid(run, order, 6 if swapped else 4, swapped)  # swapped, no node is where balls touch
    found.end()
