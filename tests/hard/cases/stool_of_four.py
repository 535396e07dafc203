"""Forces of the legs, at their centres of pressure, balance the loads in height and about both axes. The loads are 1 at (1/2, 1/2) and 1/4 at
(2/3, 2/3)."""
from judge import near
from legs import judge_legs


def judge(run):
    judge_legs(run)
    near("force of the third leg", run.pair("legc")["normal_force"], run.pair("legb")["normal_force"], relative=1e-9)
