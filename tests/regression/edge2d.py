"""13.W: exact solution with an edge of contact inside; relative error in the energy norm, integrated here.

Westergaard's Z = i c sqrt(z): sxx = Re Z - |y| Im Z', syy = Re Z + |y| Im Z', sxy = -y Re Z'.
"""
import numpy as np

from judge import near

ERRORS = {8: 1.106e-1, 16: 5.62e-2, 32: 2.83e-2, 64: 1.42e-2}
C, E, NU = 1e6, 1e9, 0.3
POINTS = 8  # per direction and cell: the gradient behaves like r^(-1/2) at one node


def exact_stress(x, y):
    z = x + 1j * np.abs(y)
    Z, dZ = 1j * C * np.sqrt(z), 0.5j * C / np.sqrt(z)
    return np.array([Z.real - np.abs(y) * dZ.imag, Z.real + np.abs(y) * dZ.imag, -y * dZ.real])


def compliance_energy(s):
    """s : C^-1 : s in plane strain."""
    return (1 + NU) / E * ((1 - NU) * (s[0] ** 2 + s[1] ** 2) - 2 * NU * s[0] * s[1] + 2 * s[2] ** 2)


def relative_energy_error(run):
    """|sigma_h - sigma| / |sigma| in the complementary energy norm over axis-parallel quads."""
    with run.fields() as file:
        points, u, cells = file["points"][()][:, :2], file["displacement"][()][:, :2], file["cells"][()]
    X, U = points[cells], u[cells]  # [cell][node][component]
    lower = X.min(axis=1)
    h = X.max(axis=1) - lower
    side = ((X - lower[:, None, :]) / h[:, None, :]).round()  # 0 or 1 per direction
    gauss, weights = np.polynomial.legendre.leggauss(POINTS)
    gauss, weights = (gauss + 1) / 2, weights / 2
    lame, mu = E * NU / ((1 + NU) * (1 - 2 * NU)), E / (2 * (1 + NU))
    error = norm = 0.0
    for s, ws in zip(gauss, weights):
        for t, wt in zip(gauss, weights):
            ns, nt = np.where(side[..., 0] > 0, s, 1 - s), np.where(side[..., 1] > 0, t, 1 - t)
            dx = np.where(side[..., 0] > 0, 1, -1) * nt / h[:, None, 0]
            dy = np.where(side[..., 1] > 0, 1, -1) * ns / h[:, None, 1]
            exx, eyy = (dx * U[..., 0]).sum(1), (dy * U[..., 1]).sum(1)
            exy = (dy * U[..., 0] + dx * U[..., 1]).sum(1) / 2
            sigma = np.array([lame * (exx + eyy) + 2 * mu * exx, lame * (exx + eyy) + 2 * mu * eyy, 2 * mu * exy])
            x, y = lower[:, 0] + s * h[:, 0], lower[:, 1] + t * h[:, 1]
            true, area = exact_stress(x, y), ws * wt * h[:, 0] * h[:, 1]
            error += (area * compliance_energy(sigma - true)).sum()
            norm += (area * compliance_energy(true)).sum()
    return float(np.sqrt(error / norm))


def judge(run):
    for n, error in ERRORS.items():
        again = run.again("-upper_dm_plex_box_faces", f"{n},{n // 2}", "-lower_dm_plex_box_faces", f"{3 * n // 4},{3 * n // 8}", name=f"n{n}")
        near(f"energy error at n = {n}", relative_energy_error(again), error, relative=5e-3)
        near(f"force at n = {n}", again.pair("joint")["normal_force"], 2 * C / 3, relative=0.2 / n)
