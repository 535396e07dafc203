"""A plank that leans against a wall, held by the friction of its foot: statics. Other corners of its ends are apart. Frictionless, it would slide down until they meet, and
positions counted from there had lost the digits of its bending: the certificate failed."""
from math import cos, sin

from judge import Run, near, require, same

ANGLE, LENGTH, THICK = 1.1, 4, 0.1
WEIGHT = LENGTH * THICK
MOST = 10  # Newton steps: 14 where each step is the part with the least energy
LEAN = (LENGTH / 2 * cos(ANGLE) - THICK / 2 * sin(ANGLE)) / (LENGTH * sin(ANGLE))  # of the wall's force and the weight


def judge(run):
    require(run.summary["solver"]["iterations"] <= MOST, f"{run.summary['solver']['iterations']} Newton steps")
    steps = run.again("-pc_type", "truncatedmg", name="iterated").summary["solver"]["iterations"]
    require(steps <= MOST, f"{steps} Newton steps by multigrid: 15 where a node between an open and a closed one of the coarser mesh begins closed, far away")
    for name, more in (("soft", ["-plank_young", "1e5", "-warnings_accept", "model_limit"]), ("stiff", ["-plank_young", "1e9"]), ("multigrid", ["-pc_type", "truncatedmg"])):
        done = run.again(*more, name=name)
        near(f"{name}: wall", done.pair("wall")["force"], [LEAN * WEIGHT, 0], relative=1e-7)
        near(f"{name}: floor", done.pair("floor")["force"], [-LEAN * WEIGHT, WEIGHT], relative=1e-7)
    refused = Run(run.program, run.mpiexec, run.ranks, run.folder / "smooth", [*run.arguments, "-floor_friction", repr(0.9 * LEAN)])
    same("exit code where friction is too small", refused.exit, 2)
