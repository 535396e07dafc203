"""Five discs in a row, pulled to a wall, and the eight rollers of a bearing: forces pass through rollers unchanged, along lines of centres."""
import math

import numpy as np
import roundmesh
from scenes import Findings, Scene, force, judge_force, require

RIM = "bottom+left+right+top"


def row(order, swapped, turned):
    """The last disc is drawn to the wall; the others weigh nothing."""
    scene = Scene(order=order)
    for k in range(5):
        scene.roller(f"d{k}", 1, 8, (2 * k, 0), turned=turned * k, young=1e3 * 3**k, force=(-1 if k == 4 else 0, 0))
    scene.plane("wall", "d0", (-1, 0), (1, 0))
    for k in range(4):
        scene.joint(f"j{k}", f"d{k}:{RIM}", f"d{k + 1}:{RIM}", swapped=swapped)
    return scene


def judge_row(run, order, swapped, turned):
    name = f"row_{order}_{turned}{'_swapped' if swapped else ''}"
    scene = row(order, swapped, turned)
    done = scene.solve(run, name)
    judge_force(name, done, "wall", (scene.measure["d4"], 0), 1e-7)
    for k in range(4):
        judge_force(name, done, f"j{k}", (-scene.measure["d4"], 0), 1e-6, swapped=swapped)


def bearing(folder, order, rollers_carry):
    """A shaft's ring that is pressed down inside eight rollers by its weight; the outer ring is held."""
    scene = Scene(order=order)
    scene.file("inner", roundmesh.ring(1.4, 2, 48, 3, order, turned=0.03), folder, young=2e5, force=(0, -1))
    scene.file("outer", roundmesh.ring(3, 3.6, 64, 3, order, turned=0.01), folder, young=2e5, bc_displacement="outer", bc_displacement_outer="0,0")
    for k in range(8):
        angle = 2 * math.pi * (k + 0.5) / 8
        scene.roller(f"r{k}", 0.5, 8, (2.5 * math.cos(angle), 2.5 * math.sin(angle)), turned=angle, young=2e5)
        scene.joint(f"i{k}", f"r{k}:{RIM}", "inner:outer", swapped=not rollers_carry)
        scene.joint(f"o{k}", f"r{k}:{RIM}", "outer:inner", swapped=not rollers_carry)
    return scene


def judge_bearing(run, order, rollers_carry):
    name = f"bearing_{order}{'' if rollers_carry else '_rings_nonmortar'}"
    scene = bearing(run.folder / "meshes" / name, order, rollers_carry)
    done = scene.solve(run, name)
    sign = 1 if rollers_carry else -1
    total = np.zeros(2)
    for k in range(8):
        inside, outside = sign * force(done, f"i{k}"), sign * force(done, f"o{k}")
        total -= inside
        out = np.array([math.cos(2 * math.pi * (k + 0.5) / 8), math.sin(2 * math.pi * (k + 0.5) / 8)])
        carried = inside @ out
        limit = 1e-6 * scene.measure["inner"]
        require(np.linalg.norm(inside + outside) <= limit, f"{name}: roller {k} is not in balance: {inside} and {outside}")
        require(np.linalg.norm(inside - carried * out) <= limit, f"{name}: roller {k} is pushed sideways: {inside - carried * out} beside {carried:.4g}")
    require(np.linalg.norm(total - [0, scene.measure["inner"]]) <= 1e-6 * scene.measure["inner"], f"{name}: rollers carry {total}")


def judge(run):
    found = Findings()
    for order in (1, 2):
        for swapped in (False, True):
            for turned in (0, 0.3):
                with found.case():
                    judge_row(run, order, swapped, turned)
            with found.case():
                judge_bearing(run, order, not swapped)
    found.end()
