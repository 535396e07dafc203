"""The same layers with their groups by number; the third has the Hooke matrix of the body, whose stress across the plane is not known."""
import numpy as np

from judge import near, same
from layers import PLANE, exact


def judge(run):
    regions = run.summary["scene"]["bodies"]["strip"]["regions"]
    same("regions", [one["name"] for one in regions], ["1", "2", "3"])
    same("moduli", [one["young"] for one in regions], [1, 1000, None])
    with run.fields() as file:
        points, u, region = file["points"][()], file["displacement"][()], file["region"][()]
    same("numbers", sorted(set(region)), [1, 2, 3])
    near("displacement", list(u[:, 1]), list(exact(PLANE, points[:, 1])), relative=1e-10)
    near("displacement along the layers", list(u[:, 0]), [0] * len(u), absolute=1e-10 * np.abs(u).max())
