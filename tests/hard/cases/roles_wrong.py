from judge import near, require
from rigid import rigid_twin


def judge(run):
    exact = rigid_twin(run, "-dm_refine", "2").pair("joint")["normal_force"]
    coarse, fine = run.pair("joint")["normal_force"], run.again("-dm_refine", "1", name="finer").pair("joint")["normal_force"]
    near("force", coarse, exact, relative=5e-3)
    require(abs(fine - exact) < 0.5 * abs(coarse - exact), f"the error falls from {coarse / exact - 1:.2g} to {fine / exact - 1:.2g} only")
