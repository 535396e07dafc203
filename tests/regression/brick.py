"""A linear displacement in space: every number of every file is known. The order of nodes in cells is that of VTK and XDMF, by their places."""
import xml.etree.ElementTree as xml

import numpy as np

from interface import vtu_arrays
from judge import near, require, same

E, NU = 1000.0, 0.25
G = np.array([[1e-2, 2e-2, 3e-2], [-4e-2, -2e-2, 1e-2], [5e-2, -1e-2, 3e-2]])  # du_i / dx_j
SHIFT = np.array([0.5, 0, -0.25])
BOX = np.array([3.0, 2.0, 1.0])
VOLUME = np.prod(BOX)
STRAIN = (G + G.T) / 2
STRESS = E / (1 + NU) * (STRAIN + NU / (1 - 2 * NU) * np.trace(STRAIN) * np.eye(3))
VOIGT = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
ROUNDING = 1e-11

# vtkTetra, vtkHexahedron, vtkQuadraticTetra, vtkTriQuadraticHexahedron: GetParametricCoords()
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
EDGES = [(.5, 0, 0), (1, .5, 0), (.5, 1, 0), (0, .5, 0), (.5, 0, 1), (1, .5, 1), (.5, 1, 1), (0, .5, 1), (0, 0, .5), (1, 0, .5), (1, 1, .5), (0, 1, .5)]
FACES = [(0, .5, .5), (1, .5, .5), (.5, 0, .5), (.5, 1, .5), (.5, .5, 0), (.5, .5, 1), (.5, .5, .5)]
TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
MIDDLES = [(.5, 0, 0), (.5, .5, 0), (0, .5, 0), (0, 0, .5), (.5, 0, .5), (0, .5, .5)]
PARAMETRIC = {4: TETRAHEDRON, 8: CORNERS, 10: TETRAHEDRON + MIDDLES, 27: CORNERS + EDGES + FACES}
VTK = {4: 10, 8: 12, 10: 24, 27: 29}
XDMF = {4: "Tetrahedron", 8: "Hexahedron", 10: "Tetrahedron_10", 27: "Hexahedron_27"}


def exact(points):
    return points @ G.T + SHIFT


def judge_cells(points, cells):
    """All cells are affine pictures of the parametric cell, and fill the brick."""
    where = np.array(PARAMETRIC[cells.shape[1]], dtype=float)
    basis = np.column_stack([np.ones(len(where)), where])
    volume = 0.0
    for cell in cells:
        affine = np.linalg.lstsq(basis, points[cell], rcond=None)[0]
        near("points of a cell", (basis @ affine).ravel(), points[cell].ravel(), absolute=1e-14 * BOX.max())
        require(np.linalg.det(affine[1:]) > 0, "a cell is inside out")
        volume += np.linalg.det(affine[1:]) * (1 if len(where) in (8, 27) else 1 / 6)
    near("volume", volume, VOLUME, relative=1e-13)


def judge_fields(run):
    size = np.abs(STRESS).max()
    with run.fields() as file:
        fields = {name: file[name][()] for name in file}
    points = fields["points"]
    near("displacement", fields["displacement"].ravel(), exact(points).ravel(), absolute=ROUNDING)
    near("stress", fields["stress"].ravel(), np.tile(STRESS.ravel(), len(points)), absolute=ROUNDING * size)
    principal = np.linalg.eigvalsh(STRESS)[::-1]
    near("principal stresses", fields["principal"].ravel(), np.tile(principal, len(points)), absolute=ROUNDING * size)
    judge_cells(points, fields["cells"])
    return fields


def judge_formats(run, fields):
    arrays = vtu_arrays(run.folder / "result.vtu")
    for name in ("points", "displacement", "stress", "von_mises", "principal", "pressure", "status", "body"):
        require(np.array_equal(arrays[name], fields[name].ravel()), f"{name} differs between VTU and HDF5")
    require(np.array_equal(arrays["connectivity"], fields["cells"].ravel()), "cells differ between VTU and HDF5")
    size = fields["cells"].shape[1]
    same("cells as VTK numbers them", set(arrays["types"].tolist()), {VTK[size]})
    for grid in xml.parse(run.folder / "result.xdmf").getroot().iter("Topology"):
        same("cells as XDMF names them", grid.get("TopologyType"), XDMF[size])


def judge_summary(summary):
    size = np.abs(STRESS).max()
    same("dimension", (summary["scene"]["model"], summary["scene"]["dimension"]), ("solid", 3))
    for probe in summary["probes"].values():
        near("displacement of a probe", probe["displacement"], exact(np.array(probe["at"])), absolute=ROUNDING)
        near("stress of a probe", probe["stress"], [STRESS[i, j] for i, j in VOIGT], absolute=ROUNDING * size)
        near("principal stresses of a probe", probe["principal"], np.linalg.eigvalsh(STRESS)[::-1], absolute=ROUNDING * size)
        deviator = STRESS - np.trace(STRESS) / 3 * np.eye(3)
        near("von Mises of a probe", probe["von_mises"], np.sqrt(1.5 * (deviator**2).sum()), absolute=ROUNDING * size)
    near("strain energy", summary["energy"]["strain"]["brick"], (STRESS * STRAIN).sum() * VOLUME / 2, relative=ROUNDING)
    near("reaction", summary["reactions"]["brick:left"], -STRESS[0] * BOX[1] * BOX[2], absolute=1e-10 * size)
    for name, value in {**summary["solver"]["kkt"], **summary["solver"]["balance"]}.items():
        require(value is not None and 0 <= value < 1e-11, f"{name} of the certificate is {value}")
    for part in (summary["errors"]["brick"], summary["errors_total"]):
        require(part["l2_relative"] < 1e-12 and part["energy_relative"] < 1e-10, f"errors of a solution that the mesh holds: {part}")


def judge(run):
    judge_summary(run.summary)
    judge_formats(run, judge_fields(run))
