"""Meshes for a number: with as many unknowns it is nearer to its limit than on meshes for the energy norm, and its bar holds."""
import math

import numpy as np

from judge import Run, read_table, require, same

FORCE = 1836995.08  # independent high-order solution, uncertain by 2e-2
MISES = 5765160     # at the probe, uncertain by 30: graded quadrilaterals of order 2 with 206,000 unknowns, and extrapolation
# goal -> column of a study, limit, how many times nearer on average of meshes with more unknowns
GOALS = {"force:joint": ("joint_normal_force", FORCE, 2, 12000), "probe:middle": ("middle_von_mises", MISES, 20, 3000)}


def judge(run):
    goal = run.summary["estimate"]["goals"][0]
    column, limit, gain, least = GOALS[goal["goal"]]
    tolerance = float(run.arguments[-1])
    require(goal["met"] and goal["bar"] <= tolerance * goal["value"], f"{goal} is not known well enough")
    if goal["goal"] == "force:joint":
        value, bar = run.pair("joint")["normal_force"], run.summary["bars"]["pairs"]["joint"]["normal_force"]
    else:
        value, bar = run.summary["probes"]["middle"]["von_mises"], run.summary["bars"]["probes"]["middle"]["von_mises"]
    same("value and bar", (value, bar), (goal["value"], goal["bar"]))
    meshes = [(mesh["unknowns"], abs(mesh["goals"][0]["value"] / limit - 1), mesh["goals"][0]["bar"] or math.inf, mesh["goals"][0]["dual_estimate"])
              for mesh in run.summary["estimate"]["meshes"]]
    for unknowns, error, bar, estimate in meshes[4:]:  # bars of five meshes
        require(error * limit <= bar, f"{unknowns} unknowns: the error {error * limit} is larger than the bar {bar}")
        if unknowns > 1000 and goal["goal"] == "force:joint":
            require(error * limit <= estimate <= 25 * error * limit, f"{unknowns} unknowns: the dual estimate {estimate} of the error {error * limit}")
    study = Run(run.program, run.mpiexec, run.ranks, run.folder / "energy", run.arguments[:-4] + ["-order", "2", "-study", "adaptive", "-study_levels", "16"])
    table = read_table(study.folder / "result_study.csv")
    energy = np.log(np.abs(np.array(table[column]) / limit - 1))
    gains = [np.interp(math.log(unknowns), np.log(table["unknowns"]), energy) - math.log(error) for unknowns, error, _, _ in meshes if unknowns > least]
    require(len(gains) >= 3, f"{len(gains)} meshes say little")
    require(np.mean(gains) >= math.log(gain), f"{goal['goal']} is {np.exp(gains)} times nearer, on average {gain} is asked for")
