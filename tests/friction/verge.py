"""A block in space 4e-4 of the coefficient within what holds it: slip grows far beyond its begin, and turns everywhere into one direction. Steps were too short, since they have the
resistance to turning of their begin: 21 before steps may become longer. Proximal point steps that another one follows need not be exact: 16 before.
Passes that slide on in one direction begin at their limit: 14 before. 3e-6 above what holds it, W is scaled after the second pass: 19 before."""
import math

from judge import near, require

MOST, CLOSER = 12, 16  # Newton steps, with those of the proximal point iteration; with a coefficient of 0.22361


def judge(run):
    pair = run.pair("joint")
    near("tangential force over normal force", math.hypot(*pair["tangential_force"]) / pair["normal_force"], math.hypot(0.2, 0.1), relative=1e-8)
    require(run.summary["solver"]["iterations"] <= MOST, f"{run.summary['solver']['iterations']} Newton steps")
    closer = run.again("-joint_friction", "0.22361", name="closer").summary["solver"]["iterations"]
    require(closer <= CLOSER, f"{closer} Newton steps with 0.22361")
