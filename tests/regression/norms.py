"""Norms of the error of a run, integrated here from its HDF5 file: independent of what the program says about its errors.

Shape functions and expressions are those of the independent solver in tests/reference.
"""
import pathlib
import sys

import numpy as np

from meshes import cells_by_size

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "reference"))
from bodies import CORNERS, Shape, evaluate, isotropic, shape_of  # pylint: disable=wrong-import-position

KINDS = {3: ("triangle", 1), 4: ("quad", 1), 6: ("triangle", 2), 9: ("quad", 2)}


def file_shape(kind, order):
    """Shape functions of cells in files: corners, middles of the edges between them, centre of a quad."""
    corners = CORNERS[kind]
    middles = [tuple(np.mean(ends, axis=0)) for ends in zip(corners, corners[1:] + corners[:1])]
    centre = [(0.5, 0.5)] if kind == "quad" else []
    return Shape(corners if order == 1 else corners + middles + centre, shape_of(kind, order).powers)


SHAPES = {key: file_shape(*key) for key in KINDS.values()}
POINTS, STEP = 6, 1e-4  # Gauss points per direction; difference for gradients, of a scene of size 1


def rule(kind):
    """Gauss points on a quad, or on a triangle by drawing one side of it together."""
    points, weights = np.polynomial.legendre.leggauss(POINTS)
    points, weights = 0.5 * (1 + points), 0.5 * weights
    for s, v in zip(points, weights):
        for t, w in zip(points, weights):
            yield ((s, t), v * w) if kind == "quad" else ((s * (1 - t), t), v * w * (1 - t))


def gradient(exact, x, y):
    """d u_i / d x_j [i][j][point] by central differences of fourth order."""
    slope = lambda u: (8 * (u(STEP) - u(-STEP)) - (u(2 * STEP) - u(-2 * STEP))) / (12 * STEP)
    return np.stack([slope(lambda h: evaluate(exact, x + h, y)), slope(lambda h: evaluate(exact, x, y + h))], axis=1)


def error_norms(run, body, exact, young, poisson):
    """(L2, energy norm, energy norm of the exact solution) of u_h - u over one body in plane strain.
    [in] body - its number; [in] exact - expressions of u"""
    hooke, sums = isotropic(young, poisson, "plane_strain"), np.zeros(3)
    with run.fields() as file:
        points, u, owner = file["points"][()][:, :2], file["displacement"][()][:, :2], file["body"][()]
        groups = cells_by_size(file["cells"][()])
    for size, (places, cells) in groups.items():
        X, U = (values[cells[owner[places] == body]] for values in (points, u))
        shape = SHAPES[KINDS[size]]
        for at, weight in rule(KINDS[size][0]):
            phi, slopes = shape.at(at)
            J = np.einsum("cni,nk->cik", X, slopes)
            grad, volume = np.einsum("nk,ckj->cnj", slopes, np.linalg.inv(J)), weight * np.abs(np.linalg.det(J))
            x, y = np.einsum("n,cni->ic", phi, X)
            du = gradient(exact, x, y)
            e, de = np.einsum("n,cni->ic", phi, U) - evaluate(exact, x, y), np.einsum("cni,cnj->ijc", U, grad) - du
            sums += [volume @ (e ** 2).sum(axis=0), *(np.einsum("ijkl,ijc,klc,c", hooke, g, g, volume) for g in (de, du))]
    return np.sqrt(sums)
