"""Curved sides on curved sides that nearly fit, and guided bodies: the force of a pair is what statics leaves to it.

A roller in a trough whose radius is 1.2 or 1.01 times its own, where an oblique weight rests; a pin with interference in a hub, by an oblique
weight; two rims side by side, one guided at its hub so that the other pushes along the line of centres; a flat follower, guided, on an
eccentric cam; a ball between a plate and a loaded plate, about an axis.
"""
import math

import numpy as np
import roundmesh
from judge import LONG
from scenes import RIM, Findings, Scene, judge_force, require

FIXED = {"bc_displacement": "outer", "bc_displacement_outer": "0,0"}


def trough(folder, order, swapped, gap):
    scene, weight = Scene(order=order), np.array([0.3, -1])
    scene.roller("roller", 1, 12, gap * weight / np.linalg.norm(weight), turned=0.9, young=1e6, force=weight)
    scene.file("trough", roundmesh.ring(1 + gap, 1.6 + gap, 48, 3, order, 0.2), folder, young=1e6, **FIXED)
    scene.joint("joint", f"roller:{RIM[2]}", "trough:inner", swapped=swapped)
    return scene, -weight * scene.measure["roller"]


def press(folder, order, swapped):
    scene, weight = Scene(order=order), np.array([0.7, -0.4])
    scene.file("pin", roundmesh.ring(0.4, 1.002, 40, 4, order, 0.1), folder, young=1e3, force=weight)
    scene.file("hub", roundmesh.ring(1, 1.6, 52, 4, order, 0.33), folder, young=1e3, **FIXED)
    scene.joint("joint", "pin:outer", "hub:inner", swapped=swapped)
    return scene, -weight * scene.measure["pin"]


def rims(folder, order, swapped, angle):
    scene, line = Scene(order=order), np.array([math.sin(angle), math.cos(angle)])
    scene.file("fixed", roundmesh.ring(0.6, 1.7, 60, 5, order, 0.05), folder, young=1e5, bc_displacement="inner", bc_displacement_inner="0,0")
    scene.file("guided", roundmesh.ring(0.4, 1, 44, 4, order, 0.4, tuple(2.7 * line)), folder, young=1e5, force=(0, -1), bc_displacement="inner",
               bc_displacement_inner="0,free")
    scene.joint("joint", "guided:outer", "fixed:outer", swapped=swapped)
    return scene, line / line[1] * scene.measure["guided"]


def follower(folder, order, swapped):
    scene = Scene(order=order)
    scene.file("cam", roundmesh.ring(0.5, 1, 56, 4, order, 0.21, (0.23, 0)), folder, young=1e5, bc_displacement="inner", bc_displacement_inner="0,0")
    scene.block("plate", (17, 4), (-1, 1), (1, 1.5), young=1e5, force=(0, -2), bc_normal="left,right")
    scene.joint("joint", "plate:bottom", "cam:outer", swapped=swapped)
    return scene, np.array([0, 2])


def between_plates(_, order, swapped):
    scene = Scene(order=order)
    scene.give(model="axisymmetric")
    scene.body("ball", young=1e5, dm_plex_simplex=0, dm_plex_box_faces="12,24", dm_plex_box_lower="0,-1", dm_plex_box_upper="1,1",
               map="x*sqrt(1-y^2/2),1+y*sqrt(1-x^2/2)")
    scene.block("base", (20, 5), (0, -0.6), (1.2, 0), young=2e5, bc_displacement="bottom", bc_displacement_bottom="0,0")
    scene.block("lid", (18, 5), (0, 2), (1.2, 2.6), young=1e5, bc_pressure="top", bc_pressure_top=3)
    scene.joint("joint", "ball:bottom+right", "base:top", swapped=swapped)
    scene.joint("top", "ball:right+top", "lid:bottom", swapped=swapped)
    return scene, np.array([0, 3 * math.pi * 1.44])


def unpaired(folder, order, aside):
    """A pin that fills a hole, turned by half a facet, without a pair of their sides. Facets overlap; bodies do where the pin is moved aside."""
    scene = Scene(order=order)
    for name, inner, outer, turned in (("pin", 0.5, 1, 0), ("hub", 1, 1.6, math.pi / 24)):
        scene.file(name, roundmesh.ring(inner, outer, 24, 3, order, turned, (aside if name == "pin" else 0, 0)), folder)
        scene.pairs.append(f"{name}_rim")
        scene.give(**{f"{name}_rim_nonmortar": f"{name}:{'inner' if name == 'pin' else 'outer'}", f"{name}_rim_obstacle": "expression",
                      f"{name}_rim_obstacle_gap": 1})
    return scene


CASES = [(trough, 0.2), (trough, 0.01), (press,), (rims, 0.7), (follower,), (between_plates,)]


def judge(run):
    found = Findings()
    for make, *more in CASES:
        for order in (1, 2):
            for swapped in (False, True) if LONG else (order == 2,):
                name = f"{make.__name__}{''.join(f'_{value}' for value in more)}_{order}{'_swapped' if swapped else ''}"
                scene, expected = make(run.folder / "meshes" / name, order, swapped, *more)
                with found.case():
                    judge_force(name, scene.solve(run, name), "joint", expected, 1e-6, swapped=swapped)
    for order, aside in ((1, 0), (2, 0), (1, 0.03), (2, 0.03)):
        name = f"unpaired_{order}_{aside}"
        with found.case():
            done = unpaired(run.folder / "meshes" / name, order, aside).solve(run, name, "-check")
            told = "overlapping_bodies" in [warning["code"] for warning in done.summary["warnings"]]
            require(told == (aside > 0), f"{name}: bodies are {'' if told else 'not '}said to overlap")
    found.end()
