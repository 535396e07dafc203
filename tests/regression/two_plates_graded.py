"""Two plates on graded cells of second order against the independent high-order computation that two_plates.py cites."""
from judge import near, require

ENERGY, FORCE, END = -5918.26337, 1836995.08, 0.31155
RATE = 10  # by which halving the cells divides the energy error: 16 in theory, 2.7 on equal cells


def judge(run):
    coarse = run.again("-dm_refine", "0", name="coarse")
    errors = [(one.summary["energy"]["potential"] - ENERGY) / abs(ENERGY) for one in (coarse, run)]
    require(0 < errors[1] <= 1e-5, f"the energy is off by {errors[1]:.2e} of itself")
    require(errors[0] >= RATE * errors[1], f"halving the cells divides the energy error by {errors[0] / errors[1]:.1f} alone")
    near("force", run.pair("joint")["normal_force"], FORCE, relative=5e-5)
    near("end of the contact", run.pair("joint")["extent"]["upper"][0], END, absolute=1e-6)
