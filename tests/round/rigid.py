"""A shrink fit against a rigid circle, by its shape and by a formula: Lame's pressure, on facets that deviate from their curve by eight times the overlap.

A hub with a rigid shaft in its bore, and a shaft in a rigid bore; from files of both orders, by a map, in space. A disc on a floor by a formula has the
force of the plane.
"""
import math

import numpy as np
import roundmesh
from judge import LONG, near, require
from scenes import Findings, Scene

YOUNG, POISSON, WITHIN, FIT, OUTSIDE, OVERLAP = 2e5, 0.3, 18, 30, 50, 0.02


def lame(held):
    """The pressure at FIT that displaces it by OVERLAP, without displacement at the other radius, in plane strain: u = A r + B / r."""
    A, B = np.linalg.solve([[FIT, 1 / FIT], [held, 1 / held]], [OVERLAP, 0])
    return abs(YOUNG / (1 + POISSON) * (A / (1 - 2 * POISSON) - B / FIT**2))


def ring(folder, bore, order, cells, by):
    """A ring by a file, or a quarter of it by a map, in the plane or in space; it is held at its other radius."""
    low, high = (FIT, OUTSIDE) if bore else (WITHIN, FIT)
    scene, angle = Scene(3 if by == "solid" else 2, order), f"y*{math.pi / 2!r}"
    held, side = {"file": ("outer", "inner"), "map": ("right", "left"), "solid": ("right", "left")}[by]
    held, side = (held, side) if bore else (side, held)
    options = {"young": YOUNG, "poisson": POISSON, "bc_displacement": held, f"bc_displacement_{held}": "0,0" + ",0" * (scene.dim == 3)}
    if by == "file":
        scene.file("ring", roundmesh.ring(low, high, cells, 4, order, 0.1), folder, **options)
    elif by == "map":
        scene.block("ring", (4, cells // 4), (low, 0), (high, 1), map=f"x*cos({angle}),x*sin({angle})", bc_normal="bottom,top", **options)
    else:
        scene.block("ring", (4, cells // 4, 2), (low, 0, 0), (high, 1, 3), map=f"x*cos({angle}),x*sin({angle}),z",
                    bc_normal="bottom,top,front,back", **options)
    return scene, side


def fit(folder, bore, formula, order, cells, by):
    (scene, side), radius = ring(folder, bore, order, cells, by), FIT + OVERLAP if bore else FIT - OVERLAP
    scene.pairs.append("joint")
    scene.give(joint_nonmortar=f"ring:{side}")
    if formula:
        scene.give(joint_obstacle="expression", joint_obstacle_gap=f"sqrt(x^2+y^2)-{radius}" if bore else f"{radius}-sqrt(x^2+y^2)")
    else:
        scene.give(joint_obstacle="cylinder" if by == "solid" else "circle", joint_obstacle_radius=radius if bore else -radius)
        if by == "solid":
            scene.give(joint_obstacle_axis="0,0,1")
    return scene


def judge_fit(run, bore, formula, order, cells, by, *words):
    name = f"{'hub' if bore else 'shaft'}_{'formula' if formula else 'shape'}_{order}_{cells}_{by}{''.join(words[:1])}"
    done = fit(run.folder / "meshes" / name, bore, formula, order, cells, by).solve(run, name, *words)
    pressure, expected = np.array(done.table("joint")["pressure"]), lame(OUTSIDE if bore else WITHIN)
    near(f"{name}: nodes in contact", done.pair("joint")["active_nodes"], len(pressure))
    near(f"{name}: mean pressure", done.pair("joint")["mean_pressure"], expected, relative=0.01)
    near(f"{name}: least and largest pressure", [pressure.min(), pressure.max()], [expected] * 2, relative=0.02)
    require(not done.summary["warnings"], f"{name}: {[warning['text'] for warning in done.summary['warnings']]}")


def judge_given(run, order, swapped):
    """The gap of a pair by a formula: a shaft 1e4 times as stiff, without an overlap of the meshes."""
    name = f"given_{order}{'_swapped' if swapped else ''}"
    scene, side = ring(run.folder / "meshes" / name, True, order, 32, "file")
    scene.file("shaft", roundmesh.ring(WITHIN, FIT, 40, 4, order, 0.2), run.folder / "meshes" / name, young=1e4 * YOUNG, bc_displacement="inner",
               bc_displacement_inner="0,0")
    scene.joint("joint", f"ring:{side}", "shaft:outer", swapped)
    scene.give(joint_gap=f"{FIT - OVERLAP}-sqrt(x^2+y^2)" if swapped else f"sqrt(x^2+y^2)-{FIT + OVERLAP}")
    near(f"{name}: mean pressure", scene.solve(run, name).pair("joint")["mean_pressure"], lame(OUTSIDE), relative=0.01)


def judge_floor(run, order):
    """A flat obstacle is met on the facets, whether it is a plane or a formula: the force at first touch is not that of an overlap."""
    forces = []
    for formula in (False, True):
        name = f"floor_{'formula' if formula else 'plane'}_{order}"
        scene = Scene(order=order)
        scene.file("disc", roundmesh.ring(0.3, 1, 32, 4, order, 0.3), run.folder / "meshes" / name, young=1e3, bc_displacement="inner",
                   bc_displacement_inner="0,0")
        if formula:
            scene.pairs.append("floor")
            scene.give(floor_nonmortar="disc:outer", floor_obstacle="expression", floor_obstacle_gap="y+0.98")
        else:
            scene.plane("floor", "disc", (0, -0.98), (0, 1), side="outer")
        forces.append(scene.solve(run, name).pair("floor")["force"][1])
    near(f"floor by a formula, order {order}", forces[1], forces[0], relative=2e-4)


def judge(run):
    found = Findings()
    cases = [(1, 32, "file"), (1, 64, "file"), (2, 32, "file"), (1, 32, "map"), (1, 32, "file", "-dm_refine", "1"), (1, 32, "file", "-adapt", "2e-2")]
    cases += [(1, 32, "solid")] + [(2, 32, "map"), (1, 64, "solid"), (1, 128, "file")] * LONG
    for bore in (True, False):
        for formula in (False, True):
            for case in cases:
                with found.case():
                    judge_fit(run, bore, formula, *case)
    for swapped in (False, True):
        with found.case():
            judge_given(run, 1, swapped)
    for order in (1, 2):
        with found.case():
            judge_floor(run, order)
    found.end()
