"""Regions with the moduli, loads and temperatures of their body change nothing but the list of regions. They have these because they give
none, or because the same values are given once more. The files hold the stress of each region at the nodes between them. Its mean by volume
is the stress of the body without regions."""
import numpy as np

from judge import near, require, same

NAMES = ["-block_regions", "soft,stiff layer"]
GIVEN = ["-block_soft_young", "7", "-block_stiff_layer_poisson", "0.3", "-block_soft_body_force", "0,-0.1*y", "-block_soft_temperature", "x*y",
         "-block_stiff_layer_thermal_expansion", "1e-3"]


def by_place(run):
    """Displacement at each place, which all points there share."""
    with run.fields() as file:
        points, u = np.round(file["points"][()], 9), file["displacement"][()]
    found = {}
    for place, value in zip(map(tuple, points), u):
        require(place not in found or (found[place] == value).all(), f"two displacements at {place}")
        found[place] = value
    return found, len(points)


def judge(run):
    require("regions" not in run.summary["scene"]["bodies"]["block"], "regions of a body without")
    with run.fields() as file:
        require("region" not in file, "the field region of a body without")
    before, num = by_place(run)
    size = max(np.abs(u).max() for u in before.values())
    joined = ["-block_regions", "soft+rest,stiff layer", "-block_soft+rest_young", "7"]
    for name, arguments in (("named", NAMES), ("given", NAMES + GIVEN), ("joined", joined)):
        other = run.again(*arguments, name=name)
        after, num_points = by_place(other)
        same("places", set(after), set(before))
        listed = [one["name"] for one in other.summary["scene"]["bodies"]["block"]["regions"]]
        same("regions", listed, ["soft+rest", "stiff layer"] if name == "joined" else ["soft", "stiff layer", None])
        require(num_points > num, "no point twice between regions")
        require(max(np.abs(after[place] - u).max() for place, u in before.items()) <= 1e-12 * size, f"{name}: displacement")
        near("force", other.pair("floor")["force"], run.pair("floor")["force"], relative=1e-12)
        for key in ("potential", "strain"):
            one, two = (r.summary["energy"][key] for r in (run, other))
            near(key, list(two.values()) if key == "strain" else two, list(one.values()) if key == "strain" else one, relative=1e-11)
