"""Blocks with an inclined bottom, held at an upright side that ends on it: the wall has W tan a, and the partner is normal to the incline. A hub on
a tapered shaft, held at its end: the axial force is the normal force times the sine of the taper."""
import math

from judge import LONG, near
from scenes import Findings, Scene, judge_force, require

WIDE = 1.3


def incline(dim, order, degrees, partner):
    """A block of unit width under a unit of pressure on top; its bottom rises along x, and its left side is held,
    as may be that of its partner: half of a wedge in a groove."""
    rise = math.tan(math.radians(degrees))
    up = "z" if dim == 3 else "y"
    along = "x, y, " if dim == 3 else "x, "
    deep = (3,) if dim == 3 else ()
    scene = Scene(dim=dim, order=order)
    scene.block("block", (5, *deep, 4), [0] * dim, [1] * dim, young=1e6, map=f"{along}{up}*(2-{rise}*x)+{rise}*x", bc_pressure="top", bc_pressure_top=1,
                bc_normal="left,front,back" if dim == 3 else "left")
    if partner == "plane":
        scene.plane("floor", "block", [0] * dim, [-rise, *[0] * (dim - 2), 1], side="bottom")
    else:
        ends = ["left"] if partner == "held" else []
        ends += ["front", "back"] if dim == 3 else []
        scene.block("base", (7, *deep, 3), [0 if partner == "held" else 1 - WIDE, *[0] * (dim - 2), -1], [WIDE, *[1] * (dim - 2), 0], young=1e6,
                    map=f"{along}{up}+(1+{up})*{rise}*x", bc_displacement="bottom", bc_displacement_bottom=",".join("0" * dim),
                    **({"bc_normal": ",".join(ends)} if ends else {}))
        scene.joint("floor", "block:bottom", "base:top")
    return scene, [-rise, *[0] * (dim - 2), 1]


def taper(order):
    scene = Scene(order=order)
    radius = "20+0.1*(y-15)"
    scene.give(model="axisymmetric", fit_gap=-0.01)
    scene.block("hub", (4, 12), (0, 0), (1, 30), young=210e3, map=f"{radius}+x*(40-({radius})), y", bc_normal="top")
    scene.block("shaft", (4, 14), (0, -5), (1, 35), young=210e3, map=f"x*({radius}), y", bc_normal="bottom")
    scene.joint("fit", "hub:left", "shaft:right")
    return scene


def judge(run):
    found = Findings()
    for dim in (2, 3):
        for order in (1, 2) if dim == 2 or LONG else (1,):
            for degrees in (0.5, 20, 45):
                for partner in ("plane", "body", "held"):
                    name = f"incline_{dim}_{order}_{degrees}_{partner}"
                    scene, expected = incline(dim, order, degrees, partner)
                    with found.case():
                        done = scene.solve(run, name, "-warnings_accept", "coarse_contact", ranks=3 if degrees == 20 else 1)
                        judge_force(name, done, "floor", expected, 1e-9)
                        near("wall", done.summary["reactions"]["block:left"][0], -expected[0], relative=1e-9)
    for order in (1, 2):
        with found.case():
            done = taper(order).solve(run, f"taper_{order}", "-warnings_accept", "model_limit")
            fit = done.pair("fit")
            axial, normal = -fit["force"][1], fit["normal_force"] * 0.1 / math.hypot(1, 0.1)
            require(abs(axial - normal) <= 1e-9 * normal, f"taper_{order}: axial force {axial:.8g} of the fit, by statics {normal:.8g}")
            near("reaction", done.summary["reactions"]["hub:top"][1], axial, relative=1e-9)
    found.end()
