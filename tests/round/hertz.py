#!/usr/bin/env python3
"""hertz.py -- largest pressure against Hertz' formula for a = .17, .1, .05, .03 R: hertz.py <program> [cells in a half width]

The scenes are a half disc of radius 1 on one of radius 2, and a ball on a ball, axisymmetric: cylinders in space would cost too much.
Both bodies are blocks of polar cells around the point of contact, small where they touch. They are so deep that what lies behind does not
matter. The largest pressure of a Hertz contact with the force that was found is

    plane: p0 = sqrt(F E* / (pi R)), a = sqrt(4 F R / (pi E*));    balls: p0 = (6 F E*^2 / (pi^3 R^2))^(1/3), a = (3 F R / (4 E*))^(1/3)

with 1/R = 1/R1 + 1/R2. It is exact for half spaces, so that the error of the bodies' shape is left. That is O((a/R)^2) in the plane,
but O(a/R) for balls: to that order their surface deforms otherwise than a half space's. So the table has the largest pressure of two
elastic balls, too, and the order of the difference from it. In the plane both are Hertz'. That pressure is by Legendre series (Lur'e,
Three-dimensional problems of the theory of elasticity, 1964, chapter 6).
"""
import math
import pathlib
import sys
import tempfile
import types

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from scenes import Scene  # noqa: E402 pylint: disable=wrong-import-position

RATIOS = (0.17, 0.1, 0.05, 0.03)
POISSON = 0.3
BALLS = ((1.0, 2000.0), (2.0, 1000.0))  # radius and modulus


def polar(radius, sign, grade):
    """A sector of [0, 1] x [0, 1]. x is along the arc up to the angle 0.6, y from the arc inward to 0.2 of the radius."""
    angle = f"(0.6*({grade}*x+{1 - grade}*x^3))"
    r = f"({radius}*(1-0.8*({grade}*y+{1 - grade}*y^3)))"
    return f"{r}*sin({angle}), {sign}*({radius}-{r}*cos({angle}))"


def scene_of(model, ratio, cells, swapped):
    """[in] ratio - of the half width that the approach makes, about"""
    R = 2 / 3
    # in the plane the approach depends on the depth as well: measured, with the depth of these blocks, a is 1.44 times that of the formula
    approach = ratio**2 * R if model == "axisymmetric" else (ratio / 1.44) ** 2 * R * (1 + math.log(4 * 1.44 / ratio))
    scene = Scene(order=2)
    if model == "axisymmetric":
        scene.give(model=model)
    grade = min(1.0, ratio * R)
    for name, radius, sign, young, n in (("upper", 1, 1, 2000, cells), ("lower", 2, -1, 1000, cells + 3)):
        scene.block(name, (n, max(8, n // 2)), (0, 0), (1, 1), young=young, poisson=POISSON, map=polar(radius, sign, grade * 0.5),
                    bc_displacement="top", bc_displacement_top=f"0,{-approach if sign > 0 else 0}", bc_normal="left")
    scene.joint("joint", "upper:bottom", "lower:bottom", swapped=swapped)
    return scene


def ball_compliance(number, radius, young):
    """Radial displacement of a ball's surface where the radial stress there is 1 times the n-th Legendre polynomial. [out] [number + 1]"""
    n, v = np.arange(2.0, number + 1), POISSON
    # displacement (A (n+1) (n-2+4v) r^(n+1) + B n r^(n-1)) P_n, stresses from it; no shear stress at the surface
    radial, shear = ((n + 1) * (n * n - n - 2 - 2 * v), n * (n - 1)), (n * n + 2 * n - 1 + 2 * v, n - 1)
    det = radial[0] * shear[1] - radial[1] * shear[0]
    A, B = shear[1] / det, -shear[0] / det
    rest = (A * (n + 1) * (n - 2 + 4 * v) + B * n) * radius * (1 + v) / young
    return np.concatenate(([radius * (1 - 2 * v) / young, 0.0], rest))  # a uniform pressure, and a rigid motion


def legendre(number, x):
    P = np.ones((number + 1, len(x)))
    P[1] = x
    for n in range(1, number):
        P[n + 1] = ((2 * n + 1) * x * P[n] - n * P[n - 1]) / (n + 1)
    return P


def two_balls(a, terms=6, cutoff=240):
    """Two elastic balls that touch in a circle of radius a: a / R, and the largest pressure over Hertz' minus 1.

    p = q (b_0 + b_1 (1 - q^2) + ..), q^2 = 1 - (r/a)^2, so that the sum of both displacements and the profile is constant for r < a."""
    place = np.linspace(0.02, 0.98, 25) * a
    s, w = np.polynomial.legendre.leggauss(400)
    q, w = (s + 1) / 2, w / 2
    shapes = np.array([q * (1 - q * q) ** j for j in range(terms)])
    given, profile = np.zeros((len(place), terms)), np.zeros(len(place))
    for radius, young in BALLS:
        number = int(cutoff / a * radius)
        degree = np.arange(number + 1)
        cosine = np.sqrt(1 - a * a * (1 - q * q) / radius**2)
        share = (2 * degree + 1) / 2 * (legendre(number, cosine) @ (shapes * a * a * q / radius**2 / cosine * w).T).T
        smooth = np.exp(-((1.5 * degree / number) ** 8))  # of the series' end
        given += ((share * ball_compliance(number, radius, young) * smooth) @ legendre(number, np.sqrt(1 - (place / radius) ** 2))).T
        profile += radius - np.sqrt(radius**2 - place**2)
    b, *_ = np.linalg.lstsq(np.hstack([given, -np.ones((len(place), 1))]), -profile, rcond=None)
    F = 2 * math.pi * a * a * float(b[:terms] @ (shapes * q * w).sum(axis=1))
    modulus, R = 1 / sum((1 - POISSON**2) / young for _, young in BALLS), 1 / sum(1 / radius for radius, _ in BALLS)
    return (3 * F * R / (4 * modulus)) ** (1 / 3) / R, b[0] / (6 * F * modulus**2 / (math.pi**3 * R**2)) ** (1 / 3) - 1


def errors(run, model, ratio, cells, swapped=False):
    """a / R and the error of the largest pressure, with the force that was found."""
    done = scene_of(model, ratio, cells, swapped).solve(run, f"{model}_{ratio}_{cells}_{swapped}")
    pair = done.pair("joint")
    modulus, R = 1 / ((1 - POISSON**2) * (1 / 2000 + 1 / 1000)), 2 / 3
    if model == "axisymmetric":
        F = abs(pair["normal_force"])
        a, p0 = (3 * F * R / (4 * modulus)) ** (1 / 3), (6 * F * modulus**2 / (math.pi**3 * R**2)) ** (1 / 3)
    else:
        F = 2 * abs(pair["normal_force"])  # of both halves
        a, p0 = math.sqrt(4 * F * R / (math.pi * modulus)), math.sqrt(F * modulus / (math.pi * R))
    return a / R, pair["max_pressure"] / p0 - 1


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    cells = int(sys.argv[2]) if len(sys.argv) > 2 else 60
    with tempfile.TemporaryDirectory() as folder:
        run = types.SimpleNamespace(program=program, mpiexec="mpiexec", folder=pathlib.Path(folder))
        print("| model | nonmortar | a / R | p0 / Hertz - 1 | two balls | difference | order |\n|---|---|---:|---:|---:|---:|---:|")
        for model in ("plane_strain", "axisymmetric"):
            for swapped in (False, True):
                last = None
                for ratio in RATIOS:
                    at, error = errors(run, model, ratio, cells, swapped)
                    balls = two_balls(at * 2 / 3)[1] if model == "axisymmetric" else 0.0
                    order = f"{math.log(abs(last[1] / (error - balls))) / math.log(last[0] / at):.2f}" if last else "-"
                    print(f"| {model} | {'lower' if swapped else 'upper'} | {at:.4f} | {error:.3e} | {balls:.3e} | {error - balls:.3e} | {order} |", flush=True)
                    last = at, error - balls


if __name__ == "__main__":
    main()
