"""A constant strain in a solid with 21 constants, all cells: stresses by an independent turn of the Hooke tensor."""
import numpy

from judge import near
from material_axes import AXES

UPPER = [120, 40, 35, 4, -3, 6, 150, 45, -5, 2, 7, 90, 3, 6, -4, 40, 2, -1, 35, 3, 50]
GRADIENT = numpy.array([[1e-3, 2e-3, -4e-4], [6e-4, -8e-4, 1e-3], [3e-4, 5e-4, 9e-4]])
VOIGT = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]


def stress():
    """sigma_ij = R_ia R_jb R_kc R_ld C_abcd eps_kl with R = AXES."""
    tensor = numpy.zeros((3, 3, 3, 3))
    numbers = iter(UPPER)
    for row in range(6):
        for column in range(row, 6):
            value = next(numbers)
            for (i, j), (k, l) in ((VOIGT[row], VOIGT[column]), (VOIGT[column], VOIGT[row])):
                for a, b, c, d in ((i, j, k, l), (j, i, k, l), (i, j, l, k), (j, i, l, k)):
                    tensor[a, b, c, d] = value
    turned = numpy.einsum("ia,jb,kc,ld,abcd->ijkl", AXES, AXES, AXES, AXES, tensor)
    sigma = numpy.einsum("ijkl,kl->ij", turned, (GRADIENT + GRADIENT.T) / 2)
    return [sigma[i, j] for i, j in VOIGT]


def constant(run, expected):
    near("stress", run.probe("inside")["stress"], expected, relative=1e-12, absolute=1e-13)
    near("displacement", run.probe("inside")["displacement"], GRADIENT @ [0.55, 0.45, 0.6], relative=1e-12, absolute=1e-16)


def judge(run):
    expected = stress()
    constant(run, expected)
    tetrahedra = ["-block_dm_plex_simplex", "1"]
    for name, words in run.some([("tetrahedra", tetrahedra), ("quadratic", ["-order", "2"]), ("both", ["-order", "2", *tetrahedra])]):
        constant(run.again(*words, name=name), expected)
    # the same constants as expressions: evaluated at every point
    constant(run.again("-block_stiffness", ",".join(f"{value}*(1+0*x)" for value in UPPER), name="expressions"), expected)
