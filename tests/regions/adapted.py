"""Adaptive meshes of a body with regions. Layers in uniaxial strain are solved exactly, so the estimate is rounding: recovery of stresses
takes nothing across a bond, where they jump. Bisected cells keep the region of their parents: the tube of Lame has the energy p u(1) pi / 4."""
import math

import numpy as np

from judge import near, require
from layers import PLANE, check_fields
from tube import LAYERS, PRESSURE, solve


def check_tube(run):
    estimate, factors = run.summary["estimate"], solve()
    require(len(estimate["meshes"]) > 1, "the mesh was not refined")
    exact = PRESSURE * (factors[0] @ [1.0, 1.0]) * math.pi / 4
    found, bar = run.summary["energy"]["strain"]["strip"], run.summary["bars"]["energy"]["strain"]["strip"]
    require(abs(found - exact) <= bar, f"strain energy {found} is not within {bar} of {exact}")
    near("strain energy", found, exact, relative=3e-3)
    for one, (inner, outer, young, _) in zip(run.summary["scene"]["bodies"]["strip"]["regions"], LAYERS):
        near("modulus", one["young"], young)
        near("volume", one["volume"], math.pi / 4 * (outer**2 - inner**2), relative=1e-2)
    with run.fields() as file:
        points, region, cells = file["points"][()], file["region"][()], file["cells"][()]
    from layers import blocks  # pylint: disable=import-outside-toplevel

    for place, mine in blocks(cells):
        r = np.hypot(*points[mine][:, :2].mean(axis=0))
        layer = {1: 0, 2: 1, 0: 2}[int(region[place])]
        require(LAYERS[layer][0] - 0.02 < r < LAYERS[layer][1], f"cell at radius {r} in layer {layer}")


def judge(run):
    if run.summary["scene"]["title"] != "Layers of one body":
        check_tube(run)
        return
    require(run.summary["estimate"]["energy_norm_relative"] < 1e-10, "the estimate sees an error where none is")
    check_fields(run, PLANE, 2)
