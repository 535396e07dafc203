"""Forces of the legs, at their centres of pressure, balance the loads in height and about both axes. The loads are 1 at (1/2, 1/2) and 1/4 at
(2/3, 2/3)."""
from judge import near, require


def judge_legs(run):
    legs = list(run.summary["pairs"].values())
    near("sum", sum(leg["normal_force"] for leg in legs), 1.25, absolute=1e-10)
    for axis in range(2):
        moment = sum(leg["normal_force"] * leg["centre_of_pressure"][axis] for leg in legs)
        near(f"moment about axis {1 - axis}", moment, 0.5 + 0.25 * 2 / 3, absolute=1e-10)
    require(all(leg["normal_force"] > 0.05 for leg in legs), "a leg does not carry")
