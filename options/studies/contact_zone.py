#!/usr/bin/env python3
"""contact_zone.py -- the figures and tables of options/CONTACT_ZONE.md: python3 options/studies/contact_zone.py <mortise> [<folder>].

Prints the tables and writes contact_zone.svg and contact_zone_shapes.svg into the folder (this one by default). About five minutes."""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from closedforms import ellipse, elliptic_punch, line, ring_punch, rounded, rounded_pressure

OPTIONS = pathlib.Path(__file__).resolve().parent.parent
BLOCKS, SPACE, R = 1000 / 0.91 / 2, 70000 / 0.91, 1000.0  # E* of contact_zone; of contact_shapes and contact_ring; radius of all
DEPTH = 0.0011  # of contact_zone at t = 1


class Program:
    """Runs scenes of options/."""

    def __init__(self, program):
        self.program = str(pathlib.Path(program).resolve())

    def run(self, scene, *arguments, table=None):
        """The summary of a scene; with the name of a pair, its table of nodes as well."""
        with tempfile.TemporaryDirectory() as folder:
            words = [self.program, "-options_file", OPTIONS / f"{scene}.opts", "-output", "r", "-quiet", *map(str, arguments)]
            done = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
            if done.returncode:
                sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
            summary = json.loads(pathlib.Path(folder, "r.json").read_text(encoding="utf-8"))
            if not table:
                return summary
            with open(pathlib.Path(folder, f"r_{table}.csv"), newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
            return summary, {key.strip(): [row[key] for row in rows] for key in rows[0]}


def show(title, head, rows):
    print(f"\n**{title}**\n\n| {' | '.join(head)} |\n|{'---:|' * len(head)}")
    for row in rows:
        print("| " + " | ".join(value if isinstance(value, str) else f"{value:.4g}" for value in row) + " |")


def sizes(program):
    """From one facet to the whole side: F of both halves, half width, largest pressure, dF/dd between steps, nodes."""
    rows, before = [], None
    for step in program.run("contact_zone_steps")["steps"]:
        pair, d = step["pairs"]["joint"], DEPTH * step["t"]
        F, nodes = 2 * pair["normal_force"], pair["active_nodes"]
        a, p0 = line(F, R, BLOCKS)
        slope = (F - before[1]) / (d - before[0]) if before else math.nan
        rows.append((step["t"], F, pair["area"], a, pair["max_pressure"], p0, slope, f"{nodes}", f"{step['iterations']}"))
        before = (d, F)
    show("size", ["t", "F'", "half width", "Hertz", "largest pressure", "Hertz", "dF'/dd", "nodes", "iterations"], rows)
    return rows


def errors(program):
    """The error in the energy norm against the finest mesh of order 2, for zones of different sizes: (t, order, a/h, error)."""
    rows = []
    for t in (1, 0.3, 0.1, 0.03, 0.01, 0.003):
        runs = program.run("contact_zone", "-upper_dm_plex_box_faces", "8,8", "-lower_dm_plex_box_faces", "6,6",
                           "-upper_bc_displacement_top", f"free,{-DEPTH * t!r}", "-study", "uniform", "-study_levels", 5, "-study_orders", "1,2")["study"]["runs"]
        F = runs[-1]["joint_normal_force"]
        a = min(line(2 * F, R, BLOCKS)[0], 1)
        rows += [(t, r["order"], a * 8 * 2**r["level"], r["energy_error_relative"], r["joint_normal_force"] / F - 1) for r in runs[:-2]]
    for order, power in ((1, 1), (2, 1.5)):
        chosen = [row for row in rows if row[1] == order]
        show(f"error, order {order}", ["t", "facets in a", "error", f"error (a/h)^{power:g}", "error of the force"],
             [(t, n, e, e * n**power, f) for t, _, n, e, f in chosen])
    return rows


def sides(program):
    """The side that may touch becomes a punch of 64 to 2 facets: the inf-sup number and the condition number."""
    rows = []
    for facets in (64, 32, 16, 8, 4, 2):
        pair = program.run("contact_zone", "-upper_dm_plex_box_faces", f"{facets},64", "-upper_dm_plex_box_upper", f"{facets / 64},1", "-joint_gap", 0,
                           "-infsup")["pairs"]["joint"]
        rows.append((f"{facets}", f"{pair['active_nodes']}", pair["inf_sup"]["number"], pair["inf_sup"]["condition"]))
    show("side that may touch", ["facets", "nodes in contact", "inf-sup number", "condition number"], rows)
    return rows


PADS = {"hollow blocks": "x^2/2000", "rounded pad": "max(0,x-0.125)^2/100", "flat pad": "x<0.125 ? 0 : 0.001"}


def pads(program):
    """Three shapes of the gap in the plane: largest pressures on meshes of 1/32 to 1/256; the profile of the finest."""
    rows, profiles = [], {}
    for name, gap in PADS.items():
        found = []
        for level in range(4):
            summary, table = program.run("contact_zone", "-joint_gap", gap, "-upper_bc_displacement_top", "free,-0.00003", "-upper_dm_plex_box_faces", "32,32",
                                         "-lower_dm_plex_box_faces", "24,24", "-dm_refine", level, table="joint")
            found.append(summary["pairs"]["joint"]["max_pressure"])
        F = 2 * summary["pairs"]["joint"]["normal_force"]
        x = np.array([float(v) for v in table["x"]])
        p = np.array([float(v) for v in table["pressure"]])
        fine = np.linspace(0, 0.3, 1201)
        if name == "hollow blocks":
            a, exact = line(F, R, BLOCKS)
            profile = exact * np.sqrt(np.maximum(1 - (fine / a)**2, 0))
        elif name == "rounded pad":
            a = rounded(F, 0.125, 50, BLOCKS)
            inside = fine < a
            profile = np.zeros_like(fine)
            profile[inside] = rounded_pressure(fine[inside], a, 0.125, 50, BLOCKS)
            exact = profile.max()
        else:
            a, exact = 0.125, math.inf
            profile = np.where(fine < a, F / math.pi / np.sqrt(np.maximum(a**2 - fine**2, 1e-30)), 0)
        profiles[name] = (F, x, p, fine, profile)
        rows.append((name, F, a, *found, "none" if math.isinf(exact) else f"{exact:.4g}", found[-1] / (F / 2 / a)))
    show("pads", ["gap", "F'", "half width", "h = 1/32", "1/64", "1/128", "1/256", "closed form", "largest over mean pressure"], rows)
    return rows, profiles


def shapes(program):
    """Zones in space: force, largest pressure and dF/dd of two neighbouring depths, beside closed forms."""
    rows = []

    def row(name, scene, gap, depth, force, forms, *arguments):
        found = [program.run(scene, "-dent_obstacle_gap", gap.format(depth * part), *arguments)["pairs"]["dent"] for part in (0.99, 1.01, 1)]
        F, p = force(found[2]), found[2]["max_pressure"]
        slope = (force(found[1]) - force(found[0])) / (0.02 * depth)
        pressure, stiffness, area = forms(F)
        rows.append((name, F, p, "none" if math.isinf(pressure) else f"{pressure:.4g}", slope, "" if math.isnan(stiffness) else f"{stiffness:.4g}",
                     area, slope / (2 * SPACE * math.sqrt(area / math.pi)), "" if math.isnan(stiffness) else f"{stiffness / (2 * SPACE * math.sqrt(area / math.pi)):.4g}"))

    def hertz(rx, ry):
        def forms(F):
            a, b, p0 = ellipse(F, rx, ry, SPACE)
            return p0, elliptic_punch(min(a, b), max(a, b), SPACE), math.pi * a * b
        return forms

    quarter, whole = (lambda pair: 4 * pair["normal_force"]), (lambda pair: pair["normal_force"])
    for name, ry in (("circle", 1000), ("ellipse 1:2.5", 4000), ("ellipse 1:6.3", 16000)):
        row(name, "contact_shapes", f"x^2/2000+y^2/{2 * ry}-{{!r}}-z", 0.000125, quarter, hertz(1000, ry))
    thin = lambda F: (line(F / 2 / math.pi, R, SPACE)[1], math.nan, 4 * math.pi * line(F / 2 / math.pi, R, SPACE)[0])
    row("ring", "contact_ring", "(x-1)^2/2000-{!r}-y", 0.00002, whole, thin)
    row("flat disc", "contact_ring", "x<1 ? 0-{!r}-y : 0.01", 0.0001, whole, lambda F: (math.inf, 2 * SPACE, math.pi))
    row("flat ring", "contact_ring", "x<1 ? (x>0.5 ? 0-{!r}-y : 0.01) : 0.01", 0.0001, whole,
        lambda F: (math.inf, 2 * SPACE * ring_punch(0.5, 1), math.pi * 0.75))
    show("shapes", ["zone", "F", "largest pressure", "closed form", "dF/dd", "closed form", "area", "dF/dd over that of a disc of this area", "closed form"], rows)
    strip = program.run("contact_shapes", "-dent_obstacle_gap", "x^2/2000-0.000125-z", "-block_bc_normal", "left,front,back,bottom")["pairs"]["dent"]
    F = 2 * strip["normal_force"] / 10
    print(f"\nstrip: F' {F:.6g}, largest pressure {strip['max_pressure']:.5g}, Hertz {line(F, R, SPACE)[1]:.5g}")
    return rows


def draw(folder, size, error, profiles):
    import matplotlib  # pylint: disable=import-outside-toplevel

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "mortise"
    import matplotlib.pyplot as plt  # pylint: disable=import-outside-toplevel

    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2))
    F = [row[1] for row in size]
    left.loglog(F, [row[2] for row in size], "o", color="C0", label="half width")
    left.loglog(F, [row[3] for row in size], "-", color="C0", label="Hertz")
    left.axhline(1, color="0.6", linewidth=0.8)
    left.text(F[0], 1.05, "whole side", color="0.4")
    left.axhline(1 / 64, color="0.6", linewidth=0.8, linestyle="--")
    left.text(F[-1], 1.05 / 64, "one facet", color="0.4", ha="right")
    left.set(xlabel="force of both halves", ylabel="half width of the zone", title="Size of the zone")
    left.legend()
    for order, power, constant, marker in ((1, 1, 0.35, "o"), (2, 1.5, 0.13, "s")):
        for number, t in enumerate(sorted({row[0] for row in error}, reverse=True)):
            chosen = [(n, e) for s, o, n, e, _ in error if s == t and o == order]
            right.loglog(*zip(*chosen), marker, color=f"C{number}", label=f"t = {t:g}" if order == 1 else None)
        n = np.array([0.5, 150])
        right.loglog(n, constant * n**-power, "-", color="0.4", linewidth=0.8)
        right.text(n[1], constant * n[1]**-power, f" order {order}", color="0.3", va="center")
    right.set(xlabel="facets in the half width, a/h", ylabel="relative error, energy norm", title="Error of the mesh: order 1 (circles), order 2 (squares)", xlim=(0.3, 500))
    right.legend(fontsize=8)
    for axes in (left, right):
        axes.grid(True, which="both", alpha=0.25)
    figure.tight_layout()
    figure.savefig(folder / "contact_zone.svg", metadata={"Date": None})
    plt.close(figure)

    figure, axes = plt.subplots(figsize=(7, 4.2))
    for number, (name, (F, x, p, fine, profile)) in enumerate(profiles.items()):
        mean = F / 0.25
        axes.plot(fine, profile / mean, "-", color=f"C{number}", linewidth=1)
        axes.plot(x[x < 0.3], p[x < 0.3] / mean, ".", color=f"C{number}", markersize=4, label=name)
    axes.set(xlabel="x", ylabel="pressure over F'/0.25", ylim=(0, 5.2), xlim=(0, 0.3), title="Three gaps: points found (h = 1/256), lines in closed form")
    axes.legend()
    axes.grid(True, alpha=0.25)
    figure.tight_layout()
    figure.savefig(folder / "contact_zone_shapes.svg", metadata={"Date": None})
    plt.close(figure)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    program, folder = Program(sys.argv[1]), pathlib.Path(sys.argv[2] if len(sys.argv) == 3 else pathlib.Path(__file__).parent)
    size = sizes(program)
    sides(program)
    _, profiles = pads(program)
    shapes(program)
    draw(folder, size, errors(program), profiles)


if __name__ == "__main__":
    main()
