"""A ring of orthotropic stiffness (r, z, hoop) without strain along its axis, whose inner or outer surface is moved by a rigid cylinder.

Equilibrium is d(r s_r)/dr = s_hoop. With u = A r^k + B r^-k it gives k^2 = c33/c11 and

    s_r = sum (k c11 + c13) A r^(k-1)   over both signs of k
"""
import math

import numpy as np

from judge import near, require

RR, RH, HH, INNER, OUTER = 100, 30, 225, 1, 2


def judge(run):
    radius = float(run.arguments[run.arguments.index("-joint_obstacle_radius") + 1])
    moved, free = (INNER, OUTER) if radius > 0 else (OUTER, INNER)
    powers = np.array([1, -1]) * math.sqrt(HH / RR)
    stress = lambda r: (powers * RR + RH) * float(r) ** (powers - 1)
    factors = np.linalg.solve([float(moved) ** powers, stress(free)], [abs(radius) - moved, 0])
    pressure = -stress(moved) @ factors
    require(pressure > 0, "the formula pulls")
    table = run.table("joint")
    near("pressure", table["pressure"], [pressure] * len(table["pressure"]), relative=1e-6)
    near("force", run.pair("joint")["normal_force"], 2 * math.pi * moved * 0.5 * pressure, relative=1e-6)
    near("strain energy", run.summary["energy"]["strain"]["ring"], math.pi * moved * 0.5 * pressure * abs(abs(radius) - moved), relative=1e-6)
