"""A pipe or a solid roller in a groove, under its own weight: its walls carry what statics says, along their normals.

W sin(b) / sin(a + b) on the wall that is inclined by a, the other one by b; W / sqrt(2) in a groove of 90 degrees.
"""
import math

import numpy as np
import roundmesh
from judge import LONG
from scenes import Findings, Scene, judge_force

PLANES = {"right": math.pi / 4, "left": math.pi / 4}  # inclinations


def wall_normal(wall, inclination):
    return np.array([-math.sin(inclination) if wall == "right" else math.sin(inclination), math.cos(inclination)])


def groove(scene, body, side, inclinations, walls, centre=(0.0, 0.0), radius=1.0, cells=(16, 3)):
    """Two walls that touch a circle. [in] walls - "plane", "blocks", or "blocks nonmortar"; [out] expected directions by pair"""
    for wall, inclination in inclinations.items():
        normal = wall_normal(wall, inclination)
        touch = np.array(centre) - radius * normal
        if walls == "plane":
            scene.plane(wall, body, touch, normal, side=side)
            continue
        angle = math.atan2(-normal[0], normal[1])  # a block whose top looks along the normal
        half = 0.8 * radius * math.tan(sum(inclinations.values()) / 4) if len(inclinations) > 1 else radius
        scene.block(f"wall{wall}", cells, (-half, -0.5 * radius), (half, 0), turned=angle, origin=touch, young=3e5, bc_displacement="bottom", bc_displacement_bottom="0,0")
        scene.joint(wall, f"{body}:{side}", f"wall{wall}:top", swapped=walls == "blocks nonmortar")


def carried(weight, inclinations):
    """By both walls, along their normals."""
    a, b = inclinations["right"], inclinations["left"]
    return {"right": weight * math.sin(b) / math.sin(a + b) * wall_normal("right", a), "left": weight * math.sin(a) / math.sin(a + b) * wall_normal("left", b)}


def judge_groove(what, scene, run, body, inclinations, walls, relative, *more, **how):
    done = scene.solve(run, what, *more, **how)
    weight = scene.measure[body]
    for pair, expected in carried(weight, inclinations).items():
        judge_force(what, done, pair, expected, relative, swapped=walls == "blocks nonmortar")
    return done


def judge(run):
    found = Findings()
    for walls in ("plane", "blocks", "blocks nonmortar"):
        for order in (1, 2):
            for refine in (0, 1, 2) if LONG or walls == "plane" and order == 1 else (0, 1):
                name = f"roller_{walls}_{order}_{refine}".replace(" ", "_")
                fine, scene = Scene(order=order), Scene(order=order)
                scene.roller("a", 1, 8, (0, 0), turned=0.2, force=(0, -1))
                fine.roller("a", 1, 8 * 2**refine, (0, 0))
                scene.measure = fine.measure
                groove(scene, "a", "bottom+left+right+top", PLANES, walls)
                with found.case():
                    judge_groove(name, scene, run, "a", PLANES, walls, 1e-9, "-dm_refine", str(refine))
            for turned in (0, 0.37, 1.9) if LONG else (0.37,):
                name = f"pipe_{walls}_{order}_{turned}".replace(" ", "_")
                scene = Scene(order=order)
                scene.file("a", roundmesh.ring(0.6, 1, 44, 3, order, turned), run.folder / "meshes" / name, force=(0, -1))
                groove(scene, "a", "outer", PLANES, walls)
                with found.case():
                    judge_groove(name, scene, run, "a", PLANES, walls, 1e-9)
    skew = {"right": 0.3, "left": 1.1}
    scene = Scene(order=2)
    scene.roller("a", 1, 8, (0, 0), turned=0.5, force=(0, -1))
    groove(scene, "a", "bottom+left+right+top", skew, "plane")
    with found.case():
        judge_groove("skew", scene, run, "a", skew, "plane", 1e-9)
    with found.case():
        judge_groove("skew_three", scene, run, "a", skew, "plane", 1e-9, "-snes_type", "vinewtonrsls", ranks=3)
    found.end()
