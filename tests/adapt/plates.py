"""Two plates (the thesis' test problem) from two cells each: potential and force of an independent high-order solution."""
import math

import numpy as np

from judge import near, require, same

POTENTIAL, FORCE = -5918.26337, 1836995.08  # uncertain by 9e-5 and 2e-2
# order -> unknowns, relative error of the potential that they are to reach: what an independent prototype of the method has
REACHED = {2: ((1500, 1.2e-3), (14000, 1.1e-5), (38000, 1.3e-6)), 1: ((11000, 1.4e-3),)}
KEPT = {2: ((1500, 8e-4), (11000, 1.1e-5), (30000, 1.3e-6)), 1: ((6500, 1.4e-3),)}  # quadrilaterals that are kept: fewer than triangles take


def judge(run):
    summary = run.summary
    meshes, order = summary["estimate"]["meshes"], summary["scene"]["bodies"]["upper"]["order"]
    sizes = [math.log(mesh["unknowns"]) for mesh in meshes]
    errors = [math.log((POTENTIAL - mesh["potential"]) / POTENTIAL) for mesh in meshes]
    kept = "kept" in run.arguments and "-lower_dm_plex_simplex" not in run.arguments
    for unknowns, error in (KEPT if kept else REACHED)[order]:
        found = math.exp(np.interp(math.log(unknowns), sizes, errors))
        require(found <= error, f"order {order}: {unknowns} unknowns have a relative error of {found} in the potential, {error} is asked for")
    for mesh in meshes:
        if mesh["unknowns"] > 1000:
            require(0.8 <= mesh["estimate"] / math.sqrt(2 * (mesh["potential"] - POTENTIAL)) <= 1.35, f"the estimate of {mesh} is off")
    total = sum(mesh["unknowns"] for mesh in meshes)
    require(total <= 3 * meshes[-1]["unknowns"], f"order {order}: all meshes have {total} unknowns, the last {meshes[-1]['unknowns']}")
    bars = summary["bars"]
    near("potential", summary["energy"]["potential"], POTENTIAL, absolute=bars["energy"]["potential"])
    near("force", summary["pairs"]["joint"]["normal_force"], FORCE, absolute=bars["pairs"]["joint"]["normal_force"])
    near("limit of the potential", summary["estimate"]["potential"]["value"], POTENTIAL, absolute=summary["estimate"]["potential"]["bar"] + 1e-4)
    near("end of contact", summary["pairs"]["joint"]["extent"]["upper"][0], 0.3115466, absolute=bars["pairs"]["joint"]["extent"]["upper"][0])
    same("bars of what grows without limit", (bars["unbounded"], bars["pairs"]["joint"]["max_pressure"]), (["joint"], None))
    validity = summary["validity"]["indicators"]  # as on the coarse uniform meshes of regression.validity: corners do not count
    near("strain", validity["strain"]["value"], 0.0038, relative=0.2)
    near("rotation", validity["rotation"]["value"], 0.0049, relative=0.2)
