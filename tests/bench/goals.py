#!/usr/bin/env python3
"""goals.py <mortise> -- two plates on meshes for a number and on meshes for the energy norm. Relative errors of the contact force and of von Mises'
stress at the probe, against unknowns. One process at a time."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

OPTIONS = pathlib.Path(__file__).resolve().parents[2] / "options"
SCENE = ["-options_file", str(OPTIONS / "two_plates.opts"), "-upper_dm_plex_box_faces", "2,2", "-lower_dm_plex_box_faces", "2,2", "-quiet"]
FORCE = 1836995.08  # independent high-order solution
GOALS = {"force:joint": "joint_normal_force", "probe:middle": "middle_von_mises"}


def solve(mortise, folder, *arguments):
    subprocess.run([mortise, *SCENE, "-output", f"{folder}/r", *arguments], capture_output=True)
    return json.loads((pathlib.Path(folder) / "r.json").read_text())


def main(mortise):
    with tempfile.TemporaryDirectory() as folder:
        truth = solve(mortise, folder, "-adapt_goal", "probe:middle", "-adapt_goal_tolerance", "1e-9", "-adapt_max_unknowns", "6e5")
        limits = {"force:joint": FORCE, "probe:middle": truth["probes"]["middle"]["von_mises"]}
        solve(mortise, folder, "-order", "2", "-study", "adaptive", "-study_levels", "18")
        table = np.genfromtxt(f"{folder}/r_study.csv", delimiter=",", names=True)
        print("| number | unknowns | error, for the number | error, for the energy norm |\n|---|---:|---:|---:|")
        for goal, column in GOALS.items():
            meshes = solve(mortise, folder, "-adapt_goal", goal, "-adapt_goal_tolerance", "1e-9", "-adapt_max_unknowns", "6e4")["estimate"]["meshes"]
            energy = np.log(np.abs(table[column] / limits[goal] - 1))
            for mesh in meshes:
                error = abs(mesh["goals"][0]["value"] / limits[goal] - 1)
                if mesh["unknowns"] > 2000:
                    other = math.exp(np.interp(math.log(mesh["unknowns"]), np.log(table["unknowns"]), energy))
                    print(f"| `{goal}` | {mesh['unknowns']} | {error:.1e} | {other:.1e} |")


if __name__ == "__main__":
    main(sys.argv[1])
