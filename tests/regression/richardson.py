"""Values that a study extrapolates, against known ones: each lies within the uncertainty that is told with it.

Parabola: an independent high-order solution for a depth of 0.04. Rings: Lame (X5), a force is a pressure times the quarter of a circle.
"""
import math

from judge import require

FIT, MIDDLE, OUTER = 0.192374956278419, 0.438392331501784, 0.215114187103554  # pressures of one fit, and of the two of three rings
KNOWN = {
    "parabola": {"joint_normal_force": 21.197056, "block_strain_energy": 0.391556675},
    "rings": {"fit_normal_force": FIT * math.pi, "bore_displacement_x": -FIT / 3000 * 8 / 3 * (1 - 0.25 ** 2), "rim_displacement_x": 5.941471376938324e-4},
    "three_bodies": {"inner_fit_normal_force": MIDDLE * math.pi, "outer_fit_normal_force": OUTER * math.pi * 2.75 / 2},
}


def judge(run):
    scene = next(word for word in run.arguments if word.endswith(".opts")).rsplit("/", 1)[-1].removesuffix(".opts")
    found = run.summary["study"]["richardson"]
    for name, value in KNOWN[scene].items():
        for order, told in found[name]["orders"].items():
            off = abs(told["value"] - value)
            require(off <= told["uncertainty"], f"{name} of order {order} is off by {off:.3g}, more than the {told['uncertainty']:.3g} it tells")
