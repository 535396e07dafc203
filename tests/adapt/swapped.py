"""Two half discs in both roles: the force of an independent high-order reference, and the same force and pressure to a thousandth and better."""
from judge import near

FORCE, PRESSURE = 0.277113, 3.080  # uncertain by 1.1e-5 and 6e-3


def judge(run):
    other = run.again("-joint_nonmortar", "lower:lower_arc", "-joint_mortar", "upper:upper_arc")
    pairs, bars = zip(*((one.pair("joint"), one.summary["bars"]["pairs"]["joint"]) for one in (run, other)))
    for pair, bar in zip(pairs, bars):
        near("force", pair["normal_force"], FORCE, absolute=bar["normal_force"] + 1.1e-5)
        near("largest pressure", pair["max_pressure"], PRESSURE, absolute=bar["max_pressure"] + 6e-3)
    near("force with swapped roles", pairs[0]["normal_force"], pairs[1]["normal_force"], relative=1e-4)
    near("largest pressure with swapped roles", pairs[0]["max_pressure"], pairs[1]["max_pressure"], relative=1e-3)
