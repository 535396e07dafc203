"""A belt that slides on a pulley. Its force T falls by mu N, N = T along the side and at a lever of 1 against 1.01, half of the thickness above it.
So it falls by exp(-mu angle / 1.01) from end to end (Eytelwein). All of it slips, which the first decisions do not see: Newton took 16 steps before
sweeps went on as long as they descend."""
import math

from judge import near, require

MOST = 12  # Newton steps from nothing, with those of the proximal point iteration


def judge(run):
    near("force at the left end", math.hypot(*run.summary["reactions"]["belt:left"]), math.exp(-0.3 * 3 / 1.01), relative=3e-3)
    require(run.summary["solver"]["iterations"] <= MOST, f"{run.summary['solver']['iterations']} Newton steps")
