"""pairing.py -- the inf-sup number of pairings of two square plates, computed without Mortise: bilinear cells, dense matrices.

The plates are those of options/two_plates.opts: clamped on top and on the bottom, a contact side of length 1. That side has
multipliers on a mesh of their own, of these kinds:

    dual        dual to the nodal functions of the upper plate, as the program has them; of the same mesh
    nodal       continuous, piecewise linear
    constant    one for each facet
"""
import numpy as np

GAUSS = np.polynomial.legendre.leggauss(3)


def stiffness(n, young, poisson, thickness=1.0):
    """K of one plate of n x n bilinear cells in plane strain; node (i, j) is i + (n + 1) j, its unknowns 2 node and 2 node + 1."""
    lame, shear = young * poisson / (1 + poisson) / (1 - 2 * poisson), young / 2 / (1 + poisson)
    C = np.array([[lame + 2 * shear, lame, 0], [lame, lame + 2 * shear, 0], [0, 0, shear]])
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    cell = np.zeros((8, 8))
    for x, wx in zip(*GAUSS):
        for y, wy in zip(*GAUSS):
            B = np.zeros((3, 8))
            dx, dy = corners[:, 0] * (1 + corners[:, 1] * y) / 4 * 2 * n, corners[:, 1] * (1 + corners[:, 0] * x) / 4 * 2 * n
            B[0, 0::2], B[1, 1::2], B[2, 0::2], B[2, 1::2] = dx, dy, dy, dx
            cell += B.T @ C @ B * wx * wy / (4 * n * n) * thickness
    K = np.zeros((2 * (n + 1)**2,) * 2)
    for i in range(n):
        for j in range(n):
            nodes = [i + (n + 1) * j, i + 1 + (n + 1) * j, i + 1 + (n + 1) * (j + 1), i + (n + 1) * (j + 1)]
            dofs = [2 * a + c for a in nodes for c in (0, 1)]
            K[np.ix_(dofs, dofs)] += cell
    return K


def compliance(n, young, poisson):
    """The normal displacements of the contact side under unit normal forces at its nodes; the opposite side is clamped."""
    free = np.arange(2 * (n + 1) * n)  # the last row of nodes is clamped
    K = stiffness(n, young, poisson)[np.ix_(free, free)]
    side = 2 * np.arange(n + 1) + 1
    forces = np.zeros((len(free), n + 1))
    forces[side, np.arange(n + 1)] = 1
    return np.linalg.solve(K, forces)[side]


def hats(n, x):
    """Nodal functions of a side of n facets at points x [len(x)][n + 1]."""
    return np.clip(1 - np.abs(n * x[:, None] - np.arange(n + 1)), 0, None)


def multipliers(kind, n, k, x):
    """Multiplier functions of a mesh of k facets at points x, which are none of its nodes [len(x)][...]; n facets of the upper side."""
    facet = np.minimum((k * x).astype(int), k - 1)
    if kind == "constant":
        return (facet[:, None] == np.arange(k)).astype(float)
    if kind == "nodal":
        return hats(k, x)
    assert kind == "dual" and k == n
    psi, at = np.zeros((len(x), n + 1)), n * x - facet
    psi[np.arange(len(x)), facet] = 2 * (1 - at) - at
    psi[np.arange(len(x)), facet + 1] = 2 * at - (1 - at)
    return psi


def number(kind, n, m, k=None, young=(1.0, 1.0), poisson=0.3, lumped=False):
    """beta for n x n cells above, m x m below and multipliers on k facets: eq. 11.9 with the integral of psi psi for N, or with the
    program's N where that is lumped."""
    k = n if k is None else k
    ends = np.unique(np.round(np.concatenate([np.arange(i + 1) / i for i in (n, m, k)]), 12))
    x = np.concatenate([(a + b) / 2 + (b - a) / 2 * GAUSS[0] for a, b in zip(ends, ends[1:])])
    weight = np.concatenate([(b - a) / 2 * GAUSS[1] for a, b in zip(ends, ends[1:])])
    psi = multipliers(kind, n, k, x)
    D, M = (psi * weight[:, None]).T @ hats(n, x), (psi * weight[:, None]).T @ hats(m, x)
    square = D @ compliance(n, young[0], poisson) @ D.T + M @ compliance(m, young[1], poisson) @ M.T  # the square of the supremum
    modulus = 1 / sum((1 - poisson**2) / E for E in young)
    N = np.diag(np.diag(D)) if lumped else (psi * weight[:, None]).T @ psi
    L = np.linalg.cholesky(N / k / modulus)
    inverse = np.linalg.inv(L)
    return float(np.sqrt(max(np.linalg.eigvalsh(inverse @ square @ inverse.T)[0], 0)))
