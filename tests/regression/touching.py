"""X2 and X3: blocks that touch without pressing, with and without loads: every node is degenerate, the set settles at once."""
import numpy as np

from judge import near, require

E, STRETCH = 100.0, {"upper": 1.0, "lower": -2.0}


def at_once(run):
    require(run.summary["solver"]["iterations"] <= 2, f"{run.summary['solver']['iterations']} steps")
    require(not any(run.summary["solver"]["changed"][1:]), "the set changes after the first step")


def judge(run):
    at_once(run)
    near("energies", [run.summary["energy"]["strain"][b] for b in ("upper", "lower")], [0.005, 0.02], relative=1e-11)
    with run.fields() as file:
        cells, body = file["cells"][()], file["body"][()]
        x, u = file["points"][()], file["displacement"][()]
    stretch = np.zeros(len(x))
    for index, value in enumerate(STRETCH.values()):
        stretch[np.unique(cells[body == index])] = value
    near("u_x", u[:, 0], stretch * x[:, 0] / E, absolute=1e-13)
    near("u_y", u[:, 1], 0 * stretch, absolute=1e-13)
    near("pressures", run.table("joint")["pressure"], [0.0] * len(run.table("joint")["pressure"]), absolute=1e-11)
    for what, place in run.pair("joint")["extent"].items():
        require(place == [None, None], f"the {what} end of a contact of no nodes is {place}")
    for start in ("full", "gap"):
        at_once(run.again("-snes_pdas_start", start, name=start))
    still = run.again("-upper_bc_traction_right", "0,0", "-lower_bc_traction_right", "0,0", name="still")
    at_once(still)
    with still.fields() as file:
        near("displacement at rest", float(np.abs(file["displacement"][()]).max()), 0.0, absolute=0.0)
