#!/usr/bin/env python3
"""adaptive.py <mortise> <chart.svg> -- error against processor time and unknowns, uniform and adaptive meshes.

Two plates from 2 x 2 cells each, whose limit is known (independent high-order reference). The error is that of the energy norm over the
solution's: the root of the relative error of the potential. Coarser meshes count in the time. Prints a table."""
import csv
import pathlib
import subprocess
import sys
import tempfile

OPTIONS = pathlib.Path(__file__).resolve().parents[2] / "options"
POTENTIAL = -5918.26337
COARSE = "-upper_dm_plex_box_faces 2,2 -lower_dm_plex_box_faces 2,2".split()
LINES = {"uniform, order 1": ("uniform", 1, 9), "uniform, order 2": ("uniform", 2, 8), "adaptive, order 1": ("adaptive", 1, 14),
         "adaptive, order 2": ("adaptive", 2, 18)}


def measure(program, kind, order, levels):
    """Unknowns, processor seconds with coarser meshes, errors."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "-options_file", OPTIONS / "two_plates.opts", *COARSE, "-order", str(order), "-study", kind, "-study_levels", str(levels),
                        "-quiet", "-output", f"{folder}/result"], check=True, stderr=subprocess.DEVNULL)
        with open(f"{folder}/result_study.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    seconds, points = 0, []
    for row in rows:
        seconds += float(row["seconds_processor"])
        points.append((int(row["unknowns"]), seconds, ((float(row["potential"]) - POTENTIAL) / -POTENTIAL) ** 0.5))
    return points


def draw(found, path):
    import matplotlib  # pylint: disable=import-outside-toplevel

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "mortise"
    import matplotlib.pyplot as plt  # pylint: disable=import-outside-toplevel

    figure, panels = plt.subplots(1, 2, figsize=(11, 4.2), sharey=True)
    for name, points in found.items():
        style = {"color": "#0072b2" if name.endswith("1") else "#d55e00", "marker": "o" if "adaptive" in name else "s",
                 "linestyle": "-" if "adaptive" in name else "--", "label": name, "markersize": 4}
        for axes, column in zip(panels, (1, 0)):
            axes.loglog([point[column] for point in points], [point[2] for point in points], **style)
    panels[0].set(xlabel="processor seconds, coarser meshes included", ylabel="relative error in the energy norm")
    panels[1].set(xlabel="unknowns")
    for axes in panels:
        axes.grid(True, which="major", alpha=0.3)
    panels[1].legend()
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def main():
    found = {name: measure(sys.argv[1], *line) for name, line in LINES.items()}
    print("| meshes | unknowns | seconds | error |\n|---|---:|---:|---:|")
    for name, points in found.items():
        print(f"| {name} | {points[-1][0]} | {points[-1][1]:.2f} | {points[-1][2]:.2e} |")
    draw(found, sys.argv[2])


if __name__ == "__main__":
    main()
