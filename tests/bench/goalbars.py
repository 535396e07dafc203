#!/usr/bin/env python3
"""goalbars.py <mortise> [--keep folder] [scene ...] -- how many error bars of goals hold.

A scene is solved once for each goal, with at most 40 000 unknowns (30 000 in space). Every mesh from the third on has a value and a bar. The truth is
a closed form, or the number on meshes for all goals and the energy norm with 250 000 unknowns (120 000). A bar is judged where the truth's own bar is
at most a third of it, or less than what it misses the truth by. Prints the ratios of bar and error of each sequence (- without a bar, u not judged),
and a table by kind. With --keep, summaries are kept there, and runs whose summary is there are not repeated. One process at a time."""
import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import tempfile

OPTIONS = pathlib.Path(__file__).resolve().parents[2] / "options"
ROUNDING = 1e-9
COARSE = "-upper_dm_plex_box_faces 2,2 -lower_dm_plex_box_faces 2,2"
SHELLS = "-outer_dm_plex_box_faces 2,2,2 -inner_dm_plex_box_faces 2,2,2"
DENT = "-block_dm_plex_box_faces 4,4,3 -probes p -probe_p_body block -probe_p_at 0.2,0.3,-0.5"
STACK = " ".join(f"-{body}_dm_plex_box_faces {cells}" for body, cells in (("table", "6,2"), ("first", "3,3"), ("second", "2,3"), ("third", "3,2"), ("fourth", "2,3"), ("fifth", "2,2")))
# scene -> options file, arguments, goals
SCENES = {
    "plates": ("two_plates", COARSE, "force:joint probe:middle"),
    "plates1": ("two_plates", f"{COARSE} -order 1", "force:joint probe:middle"),
    "stiff above": ("two_plates", "-upper_dm_plex_box_faces 3,3 -lower_dm_plex_box_faces 2,2 -upper_young 8e12", "force:joint probe:middle"),
    "edge": ("edge2d", "-upper_dm_plex_box_faces 4,2 -lower_dm_plex_box_faces 3,2 -probes p -probe_p_body upper -probe_p_at 0.5,0.4", "force:joint pressure:joint probe:p"),
    "overhang": ("overhang", "-block_dm_plex_box_faces 4,4 -table_dm_plex_box_faces 5,3 -probes p -probe_p_body block -probe_p_at 0.3,0.6", "probe:p"),
    "rings": ("rings", "-outer_dm_plex_box_faces 3,5 -inner_dm_plex_box_faces 2,4", "force:fit pressure:fit probe:bore"),
    "hertz2d": ("hertz2d", "-block_dm_plex_box_faces 12,6 -probes p -probe_p_body block -probe_p_at 0,-0.5", "force:joint pressure:joint probe:p"),
    "roller": ("roller_in_groove", "-roller_dm_plex_box_faces 8,8 -probes p -probe_p_body roller -probe_p_at 0.3,-0.6", "force:left pressure:right probe:p"),
    "parabola": ("parabola", "-block_dm_plex_box_faces 16,8 -probes p -probe_p_body block -probe_p_at 0,-0.1", "force:joint pressure:joint probe:p"),
    "stack": ("stack", f"{STACK} -probes p -probe_p_body second -probe_p_at 0.5,1.5", "force:joint3 pressure:joint2 probe:p"),
    "three": ("three_bodies", "-outer_dm_plex_box_faces 3,12 -middle_dm_plex_box_faces 3,10 -inner_dm_plex_box_faces 4,8 -probes p -probe_p_body middle -probe_p_at 1.7,1.7", "force:inner_fit pressure:outer_fit probe:p"),
    "seal": ("seal", "-rubber_dm_plex_box_faces 12,12 -plate_dm_plex_box_faces 10,3", "force:joint pressure:joint probe:bulge probe:crown"),
    "aniso": ("anisotropic_plate", "-board_dm_plex_box_faces 16,8", "pressure:rod force:rod"),
    "gears": ("gears", "", "force:first pressure:second"),
    "ring": ("contact_ring", "-block_dm_plex_box_faces 32,16 -probes p -probe_p_body block -probe_p_at 1,-0.2", "force:dent pressure:dent probe:p"),
    "hub": ("lined_hub", "", "force:fit pressure:fit probe:lining"),
    "thermal": ("thermal_fit", "", "force:fit pressure:fit probe:rim"),
    "hertzax": ("hertz_axisymmetric", "-sphere_dm_plex_box_faces 6,5 -block_dm_plex_box_faces 8,6 -probes p -probe_p_body block -probe_p_at 0.5,-1", "force:joint pressure:joint probe:p"),
    "goals": ("goals", "", "force:joint pressure:joint probe:deep"),
    "dent3d1": ("indentation", f"{DENT} -order 1", "force:dent pressure:dent probe:p"),
    "dent3d": ("indentation", f"{DENT} -order 2", "force:dent pressure:dent probe:p"),
    "gap3d": ("spherical_gap", "-upper_dm_plex_box_faces 3,3,2 -lower_dm_plex_box_faces 2,2,2", "force:joint pressure:joint probe:centre"),
    "shells3d": ("shells3d", SHELLS, "force:fit pressure:fit probe:rim probe:bore"),
    "shells3d1": ("shells3d", f"{SHELLS} -order 1", "force:fit pressure:fit probe:rim"),
}
LAME, LAME_SHELLS = 0.192374956278, 0.450005184
# closed forms; of plates an independent solution of high order
EXACT = {
    ("plates", "force:joint"): 1836995.08,
    ("plates1", "force:joint"): 1836995.08,
    ("edge", "force:joint"): 2e6 / 3,
    ("edge", "pressure:joint"): 1e6,
    ("rings", "pressure:fit"): LAME,
    ("rings", "force:fit"): math.pi * LAME,
    ("rings", "probe:bore"): 8 / 3 * LAME * math.sqrt(1 - 0.25 + 0.25**2),
    ("shells3d", "pressure:fit"): LAME_SHELLS,
    ("shells3d1", "pressure:fit"): LAME_SHELLS,
    ("thermal", "pressure:fit"): 50.5967651980,
}
NUMBERS = {"force": ("pairs", "normal_force"), "pressure": ("pairs", "max_pressure"), "probe": ("probes", "von_mises")}


def solve(program, scene, goals, unknowns, folder, *more):
    name, arguments, _ = SCENES[scene]
    file = folder / f"{scene}__{goals}__{unknowns}.json".replace(" ", "_").replace(":", "-")
    if not file.is_file():
        subprocess.run([program, "-options_file", f"{name}.opts", *arguments.split(), "-adapt_goal", goals, "-adapt_goal_tolerance", "1e-9", "-adapt_max_meshes", "40",
                        "-adapt_max_unknowns", str(unknowns), "-quiet", "-summary", file, *more], cwd=OPTIONS, capture_output=True, check=False)
    return json.loads(file.read_text())


def judge(scene, goal, meshes, true, limit, found):
    """Prints one sequence. [in] meshes - of the summary; true, limit - the truth and its bar"""
    line, kind = [], goal.split(":")[0]
    for mesh in meshes[2:]:
        value, bar = mesh["goals"][0]["value"], mesh["goals"][0]["bar"]
        error = abs(value - true)
        if bar is None or limit is None:
            line.append("-")
        elif error > ROUNDING * abs(true):
            clear = limit <= bar / 3 or error > bar + limit
            line.append(f"{bar / error:.2g}{'!' if error > bar else ''}" if clear else "u")
            if clear:
                found.setdefault(kind, []).append((error <= bar, bar / error))
    print(f"{scene} {goal}, {meshes[-1]['unknowns']} unknowns: {' '.join(line)}", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("scene", nargs="*")
    parser.add_argument("--keep", type=pathlib.Path)
    options, found = parser.parse_intermixed_args(), {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = (options.keep or pathlib.Path(temporary)).resolve()
        for scene in options.scene or SCENES:
            space = scene in ("dent3d1", "dent3d", "gap3d", "shells3d", "shells3d1")
            goals = SCENES[scene][2].split()
            truth = solve(options.program.resolve(), scene, ",".join(goals), 120000 if space else 250000, folder, "-adapt", "1e-8")
            for goal in goals:
                (block, key), name = NUMBERS[goal.split(":")[0]], goal.split(":")[1]
                limit = 0 if (scene, goal) in EXACT else truth["bars"][block][name][key]
                run = solve(options.program.resolve(), scene, goal, 30000 if space else 40000, folder)
                judge(scene, goal, run["estimate"]["meshes"], EXACT.get((scene, goal), truth[block][name][key]), limit, found)
    found["all"] = [bar for bars in found.values() for bar in bars]
    print("| goal | bars | hold | median bar / error |\n|---|---:|---:|---:|")
    for kind, bars in found.items():
        print(f"| {kind} | {len(bars)} | {100 * sum(ok for ok, _ in bars) / len(bars):.1f} % | {statistics.median(ratio for _, ratio in bars):.2g} |")


if __name__ == "__main__":
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    main()
