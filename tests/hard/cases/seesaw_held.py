"""Lever arms: two forces at their centres of pressure balance the loads; the deflection by which the plank turned closes the gap."""
from judge import near, require


def judge(run):
    edge, end = run.pair("edge"), run.pair("end")
    near("forces", edge["normal_force"] + end["normal_force"], 0.43, absolute=1e-11)
    moment = sum(pair["normal_force"] * pair["centre_of_pressure"][0] for pair in (edge, end))
    near("moment", moment, 0.03 * 0.9, absolute=1e-11)
    require(edge["normal_force"] > 0.4 and end["normal_force"] > 0.005, "one of the two does not carry")
