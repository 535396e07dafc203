"""Rigid shapes on a half space, for the force found: round ones of radius 10 (Hertz) and a cone (Love 1939; Sneddon 1965).

    round                a^3 = 3 F R / (4 E*),    p = 3 F / (2 pi a^2) sqrt(1 - r^2/a^2)
    cone of slope 0.002  F = pi a^2 E* s / 2,     p = E* s / 2 arcosh(a/r)

A plane as an obstacle pushes along its own normal, the formula of the cone along the axis. They differ by a share of the slope, 0.8 % at 0.02.
"""
import math

import numpy as np

from judge import near, require

MODULUS, RADIUS, SLOPE = 70000 / (1 - 0.33**2), 10, 0.002


def judge_round(force, r, p):
    radius = (3 * force * RADIUS / (4 * MODULUS)) ** (1 / 3)
    peak = 3 * force / (2 * math.pi * radius**2)
    near("pressure on the axis", p[np.argmin(r)], peak, relative=2e-3)
    inside = (r > 0) & (r < 0.9 * radius)
    slope, square = np.polyfit(r[inside] ** 2, p[inside] ** 2, 1)  # p^2 = p0^2 (1 - r^2/a^2)
    near("largest pressure of the profile", math.sqrt(square), peak, relative=2e-3)
    near("radius of the profile", math.sqrt(-square / slope), radius, relative=5e-3)  # the edge lies within a cell


def judge_cone(force, r, p):
    radius = math.sqrt(2 * force / (math.pi * MODULUS * SLOPE))
    inside = (r > 0.1 * radius) & (r < 0.8 * radius)
    near("pressure of the profile", p[inside], MODULUS * SLOPE / 2 * np.arccosh(radius / r[inside]), relative=5e-3)
    require(max(r[p > 1e-6 * max(p)]) < 1.1 * radius, "there is pressure outside")


def judge(run):
    table, shape = run.table("joint"), run.arguments[run.arguments.index("-joint_obstacle") + 1]
    judge_shape = judge_cone if shape == "plane" else judge_round
    judge_shape(run.pair("joint")["normal_force"], np.array(table["x"]), np.array(table["pressure"]))
