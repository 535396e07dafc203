"""The answer does not depend on who computes it: both solvers (the run has -cross_check), any number of ranks."""
import re

import numpy as np

from judge import LONG, near, require, same, same_table
from meshes import bodies_of_nodes

FIELDS = 1e-9  # relative to the largest value of a field
BULK = 1e-12  # the same for stresses, times bulk over shear modulus: strains with so much less volume keep so many digits less
RHO = 1e-2  # the same of rho in parts of its error, which iterative solvers of systems make
RANKS = (2, 3, 4) if LONG else (3,)


def fields(run):
    """Displacement and stress at nodes, sorted by body and place, so that numbering does not matter."""
    with run.fields() as file:
        points, cells, body = file["points"][()], file["cells"][()], file["body"][()]
        values = np.hstack([file["displacement"][()], np.nan_to_num(file["stress"][()])])
    places = (points / np.abs(points).max()).round(9) + 0.0  # no -0
    return values[np.lexsort(np.column_stack([places, bodies_of_nodes(cells, body, len(points))]).T)]


def stress_tolerance(run):
    """FIELDS, unless some body is nearly incompressible."""
    poisson = [float(text) for name, text in run.summary["options"].items() if re.fullmatch(r".*_poisson", name) and re.fullmatch(r"[\d.]+", text)]
    if run.summary["options"].get("model") == "plane_stress":
        return FIELDS
    return max([FIELDS] + [BULK * 2 * (1 + nu) / (3 * (1 - 2 * nu)) for nu in poisson])


def compare(run, other, what):
    mine, theirs = fields(run), fields(other)
    for columns, name, allowed in ((slice(0, 3), "displacement", FIELDS), (slice(3, 12), "stress", stress_tolerance(run))):
        scale = np.abs(mine[:, columns]).max()
        off = np.abs(mine[:, columns] - theirs[:, columns]).max()
        require(off <= allowed * scale, f"{name} on {what}: off by {off:.3g} of {scale:.3g}")
    friction = [one.summary["solver"].get("friction") for one in (run, other)]
    if friction[0] and friction[0]["rho"] is not None:
        near(f"rho on {what}", friction[1]["rho"], friction[0]["rho"], absolute=max(FIELDS, RHO * friction[0]["rho_error"]))
    for pair, values in run.summary["pairs"].items():
        same(f"active nodes of {pair} on {what}", other.pair(pair)["active_nodes"], values["active_nodes"])
        stress = np.abs(mine[:, 3:]).max()  # where nothing presses, pressures are roundoff of this
        same_table(other.table(pair), run.table(pair), {"pressure": (FIELDS, 1e-12 * stress)})
        same_table(other.table(pair), run.table(pair), {"status": (0.0, 0.0)})


def judge(run):
    check = run.summary["solver"]["cross_check"]
    require(check["converged"] and check["agree"], "pdas and vinewtonrsls disagree")
    same("difference of the active sets", check["active_difference"], 0)
    require(check["displacement_difference"] < 1e-9, f"displacements differ by {check['displacement_difference']:.3g}")
    for ranks in RANKS:
        compare(run, run.again("-cross_check", "0", ranks=ranks, name=f"ranks{ranks}"), f"{ranks} ranks")
