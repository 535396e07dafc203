"""-stop discretisation where sides do not meet: the residual at open nodes has both signs, and is no contact force."""
from math import sqrt

from judge import require, same


def judge(run):
    exact = run.again("-stop", "residual", name="whole").summary["energy"]["potential"]
    solver, energy = run.summary["solver"], run.summary["energy"]["potential"]
    same("nodes in contact", solver["active"], 0)
    bound = solver["energy_bound"]["absolute"]
    require(sqrt(2 * max(energy - exact, 0)) <= 1.2 * bound, f"the error {sqrt(2 * (energy - exact))} above its bound {bound}")
