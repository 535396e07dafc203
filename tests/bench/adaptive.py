#!/usr/bin/env python3
"""adaptive.py <mortise> <chart.svg> [--again <points.json>] [--keep <points.json>] -- error against processor time, uniform and adaptive meshes.

Two plates from 2 x 2 cells each, whose limit is known (independent high-order reference). Hertz in the plane and in space, a wheel on a rail, two
gears: their limit is that of the finest adaptive mesh less its estimated error. Points within three bars of it are omitted. The error is that of
the energy norm over the solution's: the root of the relative error of the potential. Coarser meshes count in the time. Prints a table.

adaptive.py --loop <bench_loop> -- what the meshes, the estimate and the whole loop cost beside one solve on the last mesh, in processor time."""
import argparse
import csv
import json
import pathlib
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
OPTIONS = HERE.parents[1] / "options"
COARSE = "-upper_dm_plex_box_faces 2,2 -lower_dm_plex_box_faces 2,2".split()
BOTH = {"uniform, order 1": ("uniform", 1), "uniform, order 2": ("uniform", 2), "adaptive, order 2": ("adaptive", 2)}
# title -> options, meshes of each line, limit of the potential if known
SCENES = {
    "two plates": (OPTIONS / "two_plates.opts", COARSE, (9, 8, 18), -5918.26337),
    "Hertz in the plane, from a file": (OPTIONS / "hertz2d.opts", [], (4, 3, 7), None),
    "gears, from a file": (OPTIONS / "gears.opts", [], (4, 3, 6), None),
    "Hertz in space": (HERE / "hertz_space.opts", [], (3, 2, 6), None),
    "wheel on a rail, from a file": (OPTIONS / "wheel_on_rail.opts", [], (3, 2, 3), None),
}
LOOPS = {
    "two plates": [OPTIONS / "two_plates.opts", *COARSE, "-adapt_max_unknowns", "8e4"],
    "two plates, multigrid": [OPTIONS / "two_plates.opts", *COARSE, "-adapt_max_unknowns", "8e4", "-pc_type", "truncatedmg"],
    "gears": [OPTIONS / "gears.opts", "-adapt_max_unknowns", "1e5"],
    "hertz2d": [OPTIONS / "hertz2d.opts", "-adapt_max_unknowns", "1e5"],
    "Hertz in space": [HERE / "hertz_space.opts", "-adapt_max_unknowns", "6e4"],
}


def measure(program, scene, more, kind, order, levels):
    """Unknowns, processor seconds with coarser meshes, potentials of a study; limit of the potential and its bar on the finest mesh."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "-options_file", scene, *more, "-order", str(order), "-study", kind, "-study_levels", str(levels), "-quiet",
                        "-output", f"{folder}/result"], check=True, stderr=subprocess.DEVNULL)
        with open(f"{folder}/result_study.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        summary = json.loads(pathlib.Path(f"{folder}/result.json").read_text(encoding="utf-8"))
    seconds, points = 0, []
    for row in rows:
        seconds += float(row["seconds_processor"])
        points.append((int(row["unknowns"]), seconds, float(row["potential"])))
    limit = summary["estimate"]["potential"] if kind == "adaptive" else None
    return {"points": points, "limit": limit}


def measure_all(program):
    found = {}
    for title, (scene, more, levels, known) in SCENES.items():
        lines = {name: measure(program, scene, more, *line, number) for (name, line), number in zip(BOTH.items(), levels)}
        found[title] = {"lines": {name: line["points"] for name, line in lines.items()},
                        "limit": {"value": known, "bar": 0} if known else lines["adaptive, order 2"]["limit"]}
        print(f"{title}: measured", flush=True)
    return found


def errors(scene):
    """name -> (unknowns, seconds, error) of the meshes whose error is known."""
    limit = scene["limit"]
    return {name: [(n, t, ((J - limit["value"]) / abs(limit["value"])) ** 0.5) for n, t, J in points if J - limit["value"] > 3 * limit["bar"]]
            for name, points in scene["lines"].items()}


def draw(found, path):
    import matplotlib  # pylint: disable=import-outside-toplevel

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "mortise"
    import matplotlib.pyplot as plt  # pylint: disable=import-outside-toplevel

    figure, panels = plt.subplots(2, 3, figsize=(12, 7))
    panels = list(panels.flat)
    for axes, (title, scene) in zip(panels, found.items()):
        for name, points in errors(scene).items():
            axes.loglog([point[1] for point in points], [point[2] for point in points], color="#0072b2" if name.endswith("1") else "#d55e00",
                        marker="o" if "adaptive" in name else "s", linestyle="-" if "adaptive" in name else "--", label=name, markersize=4)
        axes.set(title=title, xlabel="processor seconds, coarser meshes included", ylabel="relative error in the energy norm")
        axes.grid(True, which="major", alpha=0.3)
    last = panels[-1]
    last.axis("off")
    last.legend(*figure.axes[0].get_legend_handles_labels(), loc="center")
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def print_table(found):
    print("| scene | meshes | unknowns | seconds | error |\n|---|---|---:|---:|---:|")
    for title, scene in found.items():
        for name, points in errors(scene).items():
            if points:
                print(f"| {title} | {name} | {points[-1][0]} | {points[-1][1]:.2f} | {points[-1][2]:.2e} |")


def print_loops(program):
    print("| scene | unknowns | meshes | sum of unknowns | sets | seconds | mesh % | estimate % | one solve, s | loop / one |\n" + "|---|" + 9 * "---:|")
    for title, (scene, *more) in LOOPS.items():
        command = [pathlib.Path(program).resolve(), "-options_file", scene, "-order", "2", "-adapt", "1e-6", *more, "-quiet"]
        run = subprocess.run(command, check=True, capture_output=True, text=True, cwd=scene.parent)  # its paths of meshes are PETSc's
        lines = [dict(zip(line.split()[1::2], line.split()[2::2])) for line in run.stdout.splitlines() if line.startswith(("mesh ", "loop "))]
        *meshes, loop = lines
        sets = ",".join(mesh["sets"] for mesh in meshes)
        print(f"| {title} | {loop['unknowns']} | {len(meshes)} | {float(loop['sum']):.2f} | {sets} | {float(loop['seconds']):.2f} | "
              f"{100 * float(loop['mesh']):.1f} | {100 * float(loop['estimate']):.1f} | {float(loop['once_seconds']):.2f} | {float(loop['over']):.2f} |")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("chart", nargs="?")
    parser.add_argument("--loop", action="store_true")
    parser.add_argument("--again", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path)
    given = parser.parse_args()
    if given.loop:
        print_loops(given.program)
        return
    found = json.loads(given.again.read_text(encoding="utf-8")) if given.again else measure_all(given.program)
    if given.keep:
        given.keep.write_text(json.dumps(found), encoding="utf-8")
    print_table(found)
    draw(found, given.chart)


if __name__ == "__main__":
    main()
