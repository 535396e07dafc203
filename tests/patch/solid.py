"""A uniform pressure of 1e6 passes through solids and their joints, whatever the cells, straight up, turned in space and confined."""
from judge import near
from uniform import PRESSURE, pressures

POISSON = 0.3
TOLERANCE = 1e-11
TURN = [[2 / 3, -2 / 3, 1 / 3], [1 / 3, 2 / 3, 2 / 3], [-2 / 3, -1 / 3, 2 / 3]]  # a rotation, no axis of which is special
TURN_MAP = "(2*x-2*y+z)/3, (x+2*y+2*z)/3, (2*z-2*x-y)/3"
UPRIGHT = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def column(run, tolerance=TOLERANCE, turn=None, lateral=0.0):
    """p = 1e6 at every multiplier; sigma = Q diag(lateral, lateral, -1e6) Q' at every node."""
    turn = turn or UPRIGHT
    pressures(run, tolerance)
    with run.fields() as file:
        stress = file["stress"][()]  # 3 x 3, row by row
    for i in range(3):
        for j in range(3):
            expected = lateral * (i == j) - (PRESSURE + lateral) * turn[i][2] * turn[j][2]
            near(f"sigma_{'xyz'[i]}{'xyz'[j]}", stress[:, 3 * i + j], [expected] * len(stress), absolute=tolerance * PRESSURE)


def bodies(run):
    return run.summary["options"]["bodies"].split(",")


def turned(run, *arguments, **keywords):
    """The same scene, every body turned about the origin."""
    maps = [word for body in bodies(run) for word in (f"-{body}_map", TURN_MAP)]
    return run.again(*maps, *arguments, **keywords)


def judge(run):
    column(run)
    column(turned(run, "-snes_type", "vinewtonrsls", name="turned"), turn=TURN)
    confined = [word for body in bodies(run) for word in (f"-{body}_bc_normal", "left,right,front,back" + ",bottom" * (body == "lower"))]
    column(run.again(*confined, name="confined"), lateral=-PRESSURE * POISSON / (1 - POISSON))
