"""A shaft on a block from cells of 150 half widths. Hertz' largest pressure and stress under it, for the force that is found, lie within the bars."""
import math

from judge import Run, near, require, same

MODULUS, NU = 1000 / (1 - 0.3**2), 0.3


def judge(run):
    goals = {goal["goal"]: goal for goal in run.summary["estimate"]["goals"]}
    require(all(goal["met"] and goal["bar"] <= 0.01 * goal["value"] for goal in goals.values()), f"{goals}")
    force, pressure, stress = goals["force:joint"], goals["pressure:joint"], goals["probe:deep"]
    a = math.sqrt(8 * force["value"] / (math.pi * MODULUS))
    largest = 4 * force["value"] / (math.pi * a)
    near("largest pressure", pressure["value"], largest, absolute=pressure["bar"])
    z = -run.summary["probes"]["deep"]["at"][1]
    s = math.hypot(a, z)
    x, y = -largest * ((a * a + 2 * z * z) / (a * s) - 2 * z / a), -largest * a / s
    mises = math.sqrt(((x - y)**2 + (y - NU * (x + y))**2 + (NU * (x + y) - x)**2) / 2)
    near("von Mises' stress", stress["value"], mises, absolute=stress["bar"])
    require(run.summary["estimate"]["meshes"][-1]["unknowns"] < 10000, "more unknowns than this takes")
    few = Run(run.program, run.mpiexec, run.ranks, run.folder / "few", run.arguments + ["-adapt_max_meshes", "3"])
    same("exit", few.exit, 3)
    same("nodes in contact on the third mesh", few.pair("joint")["active_nodes"], 0)
    for goal in few.summary["estimate"]["goals"]:
        near(f"{goal['goal']} on three meshes", goal["value"], goals[goal["goal"]]["value"], absolute=goal["bar"])
