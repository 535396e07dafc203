"""Orders of convergence in space, against a solution of third degree, and what is extrapolated."""
from judge import near, require
from studies import block, judge_files, one, rows


def judge(run):
    judge_files(run, orders=(1, 2), levels=3)
    table = rows(run)
    for order in (1, 2):
        finest = one(table, order, 2)
        near(f"rate in the energy norm, order {order}", finest["energy_error_rate"], order, absolute=0.1)
        near(f"rate in L2, order {order}", finest["l2_error_rate"], order + 1, absolute=0.15)
        near("h", finest["h"], 3**0.5 / 8, relative=1e-12)
        near("unknowns", finest["unknowns"], 3 * (8 * order + 1) ** 3, absolute=0)
    energy = block(run)["richardson"]["cube_strain_energy"]
    exact = strain_energy()
    require(abs(energy["value"] - exact) <= 2 * energy["uncertainty"] + 1e-12, f"{energy} for {exact}")
    near("displacement of the middle", one(table, 2, 2)["middle_displacement_x"], 0.01 / 8, relative=1e-3)


def strain_energy():
    """int (lambda/2 (div u)^2 + mu eps : eps) by Gauss points that are exact for these polynomials."""
    import numpy as np  # pylint: disable=import-outside-toplevel

    places, weights = np.polynomial.legendre.leggauss(4)
    places, weights = (places + 1) / 2, weights / 2
    x, y, z = np.meshgrid(places, places, places, indexing="ij")
    zero = 0 * x
    g = 0.01 * np.array([[3 * x * x, zero, zero], [zero, z * z, 2 * y * z], [y * z, x * z, x * y]])
    eps = (g + g.transpose(1, 0, 2, 3, 4)) / 2
    density = 200 * np.trace(eps) ** 2 + 400 * (eps * eps).sum(axis=(0, 1))
    return float(np.einsum("ijk,i,j,k", density, weights, weights, weights))
