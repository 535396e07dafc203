"""Lame's solution for a tube of layers that are bonded: u = A_i r + B_i / r in each; six numbers from the pressures inside and outside
and from u and sigma_rr at the bonds. Plane strain: sigma = 2 mu / (1 - 2 nu) A -+ 2 mu B / r^2."""
import numpy as np

from judge import near, require

PRESSURE = 0.01
LAYERS = [(1.0, 1.3, 1.0, 0.2), (1.3, 1.7, 1000.0, 0.4), (1.7, 2.0, 5.0, 0.3)]  # radii, E, nu


def stress(layer, r, sign):
    """Factors of A and B: sign -1 for sigma_rr, 1 for sigma_tt."""
    _, _, young, poisson = layer
    return np.array([young / ((1 + poisson) * (1 - 2 * poisson)), sign * young / ((1 + poisson) * r**2)])


def solve():
    matrix, rhs = np.zeros((6, 6)), np.zeros(6)
    matrix[0, 0:2], rhs[0] = stress(LAYERS[0], 1.0, -1), -PRESSURE
    matrix[1, 4:6] = stress(LAYERS[2], 2.0, -1)
    for i, r in enumerate((1.3, 1.7)):
        own, next_one = slice(2 * i, 2 * i + 2), slice(2 * i + 2, 2 * i + 4)
        matrix[2 + 2 * i, own], matrix[2 + 2 * i, next_one] = [r, 1 / r], [-r, -1 / r]
        matrix[3 + 2 * i, own], matrix[3 + 2 * i, next_one] = stress(LAYERS[i], r, -1), -stress(LAYERS[i + 1], r, -1)
    return np.linalg.solve(matrix, rhs).reshape(3, 2)


def hoop_error(run, factors):
    """Largest error of the hoop stress at the points of the file, relative to the largest stress of its layer."""
    with run.fields() as file:
        points, tensor, region, cells = (file[name][()] for name in ("points", "stress", "region", "cells"))
    ring, worst = run.summary["scene"]["model"] == "axisymmetric", [0.0, 0.0, 0.0]
    from layers import blocks  # pylint: disable=import-outside-toplevel

    for place, mine in blocks(cells):
        layer = {1: 0, 2: 1, 0: 2}[int(region[place])]
        for point, s in zip(points[mine], tensor[mine]):
            r = point[0] if ring else np.hypot(point[0], point[1])
            across = np.array([-point[1], point[0], 0]) / r
            found = s[8] if ring else across @ s.reshape(3, 3) @ across
            largest = max(abs(factors[layer] @ stress(LAYERS[layer], at, 1)) for at in LAYERS[layer][:2])
            worst[layer] = max(worst[layer], abs(found - factors[layer] @ stress(LAYERS[layer], r, 1)) / largest)
    return max(worst)


def judge(run):
    factors = solve()
    places = {"inner": (0, 1.0), "first": (1, 1.3), "second": (2, 1.7), "outer": (2, 2.0)}
    exact = [factors[layer] @ [r, 1 / r] for layer, r in places.values()]
    near("radial displacements", [run.probe(name)["displacement"][0] for name in places], exact, relative=1e-3)
    finer = run.again("-dm_refine", "1", name="finer")
    near("of the finer mesh", [finer.probe(name)["displacement"][0] for name in places], exact, relative=1e-4)
    errors = hoop_error(run, factors), hoop_error(finer, factors)
    require(errors[0] < 0.02, f"hoop stress: {errors[0]}")
    require(errors[1] < errors[0] / 2.5, f"hoop stress: {errors} do not fall with the mesh")
