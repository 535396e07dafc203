"""A belt that slides on a pulley. Its force T falls by mu N, N = T along the side and at a lever of 10 against 10 and half of the thickness.
So it falls by exp(-mu angle / 1.01) from end to end (Eytelwein). All of it slips, which the first decisions do not see, and the contact of nodes that stick spreads by
the bending length in each step: up to 45 steps by the dense system and 97 by multigrid, which also failed, before the iteration went on from the solution without
friction. By the dense system that took 10 steps while its first set followed from forces, and not from what touches. With a coefficient above 1 a smaller one was solved first: 25 steps by multigrid with 2, 46 with 3. Pressures of 1e-9 of the largest are found by pivoting: with coefficients of 7
and more it ended too early (exit code 3). Where steps of multigrid stall with such a coefficient, the dense system takes
its place."""
import math

from judge import near, require

MOST = {"cholesky": 8, "truncatedmg": 12}  # Newton steps from nothing, with those of the proximal point iteration and those without friction
CASES = ((100, 0.3, "cholesky"), (50, 0.6, "cholesky"), (150, 0.6, "cholesky"), (300, 0.3, "cholesky"), (50, 0.6, "truncatedmg"), (200, 0.2, "truncatedmg"), (300, 0.3, "truncatedmg"),
         (100, 2, "truncatedmg"), (100, 3, "truncatedmg"), (50, 7, "cholesky"), (100, 5, "truncatedmg"))
REPLACED = 2  # the coefficient from which on steps of multigrid stall, and the dense system takes its place
SMALL = 3  # the coefficient from which on the force is compared with the pull: bending makes it larger than by friction alone
ACCEPTED = "coarse_contact,not_unique,large_friction,solver_replaced"
PULL, ERROR = 100, 0.07  # of the force, over mu^2: the thickness, and some cells of 50


def left(done):
    return math.hypot(*done.summary["reactions"]["belt:left"])


def judge(run):
    near("force at the left end", left(run), PULL * math.exp(-0.9 / 1.01), relative=1.5e-3)
    table = run.table("bar")
    arc, pressure = table["arc_length"], table["pressure"]
    middle = [i for i, s in enumerate(arc) if 3 < abs(s - arc[0]) < 27]
    for i, j in zip(middle, middle[100:]):
        near(f"pressures at {arc[i]} and {arc[j]}", pressure[max(i, j, key=lambda k: table["x"][k])] * math.exp(-0.3 * abs(arc[j] - arc[i]) / 10 / 1.01),
             pressure[min(i, j, key=lambda k: table["x"][k])], relative=0.01)
    for cells, mu, solver in CASES:
        name = f"belt{cells}_{mu}_{solver}"
        done = run.again("-belt_dm_plex_box_faces", f"{cells},1", "-bar_friction", str(mu), "-pc_type", solver, *(("-warnings_accept", ACCEPTED) if mu > 1 else ()), name=name)
        near(f"{name}: force at the left end", left(done), PULL * math.exp(-mu * 3 / 1.01), absolute=2e-4 * PULL if mu >= SMALL else 0, relative=min(ERROR * mu**2, 3e-3 if mu < 0.5 else 1))
        require(done.summary["solver"]["gave_way"] == (solver == "truncatedmg" and mu >= REPLACED), f"{name}: gave way or not")
        require(done.summary["solver"]["iterations"] <= MOST[solver], f"{name}: {done.summary['solver']['iterations']} Newton steps")
