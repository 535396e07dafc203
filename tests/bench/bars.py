#!/usr/bin/env python3
"""bars.py <mortise> [--part 0.1] [--keep folder] [scene ...] -- how many error bars hold, against the same scenes on much finer meshes.

The truth of a scene is a closed form where EXACT has one, else its run by -adapt with as many unknowns as TRUTHS has. That of order 1 is the run of
order 2, where SCENES has it. Runs with 3, 4, ... meshes are judged, up to four less than the truth has, in space one; of order 1 with up to a quarter of
the unknowns of order 2. Each has its own bars. A bar is judged where the truth's own bar is at most --part of it, or where it misses the truth by more
than that one's bar. Prints misses; bars, misses in brackets and the median ratio of bar and error by scene and kind of number, then by kind and by class
of scene; and the effectivity of the estimate. With --keep, summaries are kept there, and runs whose summary is there are not repeated. One process at a
time."""
import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

OPTIONS = pathlib.Path(__file__).resolve().parents[2] / "options"
ROUNDING = 1e-9  # numbers that differ by less of their size have no error to speak of
RINGS = "-outer_dm_plex_box_faces 3,5 -inner_dm_plex_box_faces 2,4"
TIGHT = "-upper_dm_plex_box_faces 2,2 -lower_dm_plex_box_faces 2,2 -upper_poisson 0.4999 -lower_poisson 0.4999"
STACK = " ".join(f"-{body}_dm_plex_box_faces {cells}" for body, cells in
                 (("table", "6,2"), ("first", "3,3"), ("second", "2,3"), ("third", "3,2"), ("fourth", "2,3"), ("fifth", "2,2")))
# scene -> options file, arguments
SCENES = {
    "two plates": ("two_plates", "-upper_dm_plex_box_faces 2,2 -lower_dm_plex_box_faces 2,2"),
    "two plates, order 1": ("two_plates", "-upper_dm_plex_box_faces 2,2 -lower_dm_plex_box_faces 2,2 -order 1"),
    "stiff above": ("two_plates", "-upper_dm_plex_box_faces 3,3 -lower_dm_plex_box_faces 2,2 -upper_young 8e12"),
    "stiff below": ("two_plates", "-upper_dm_plex_box_faces 3,3 -lower_dm_plex_box_faces 2,2 -lower_young 8e12"),
    "tight plates": ("two_plates", TIGHT),
    "tight plates, kept": ("two_plates", f"{TIGHT} -adapt_cells kept"),
    "tight plates, kept, order 1": ("two_plates", f"{TIGHT} -order 1 -adapt_cells kept"),
    "stiff triangles": ("two_plates", "-upper_dm_plex_box_faces 2,2 -lower_dm_plex_box_faces 2,2 -upper_poisson 0.45 -lower_poisson 0.45 -order 1"),
    "half space edge": ("edge2d", "-upper_dm_plex_box_faces 4,2 -lower_dm_plex_box_faces 3,2"),
    "overhang": ("overhang", "-block_dm_plex_box_faces 4,4 -table_dm_plex_box_faces 5,3"),
    "rings": ("rings", RINGS),
    "anisotropic": ("anisotropic_plate", "-board_dm_plex_box_faces 16,8"),
    "seal": ("seal", "-rubber_dm_plex_box_faces 12,12 -plate_dm_plex_box_faces 10,3"),
    "punch": ("punch", ""),
    "hertz2d, order 1": ("hertz2d", "-order 1"),
    "half discs": ("half_discs", ""),
    "roller": ("roller_in_groove", "-roller_dm_plex_box_faces 8,8"),
    "indentation in space": ("indentation", "-block_dm_plex_box_faces 4,4,3"),
    "parabola": ("parabola", "-block_dm_plex_box_faces 16,8"),
    "stack": ("stack", STACK),
    "three bodies": ("three_bodies", "-outer_dm_plex_box_faces 3,12 -middle_dm_plex_box_faces 3,10 -inner_dm_plex_box_faces 4,8"),
    "tied plates": ("two_plates", "-upper_dm_plex_box_faces 3,3 -lower_dm_plex_box_faces 2,2 -joint_type tied"),
    "dent around an axis": ("contact_ring", "-block_dm_plex_box_faces 32,16"),
    "lined hub": ("lined_hub", ""),
    "thermal fit": ("thermal_fit", ""),
    "gears": ("gears", ""),
    "hertz around an axis": ("hertz_axisymmetric", "-sphere_dm_plex_box_faces 6,5 -block_dm_plex_box_faces 8,6"),
    "spherical gap in space": ("spherical_gap", "-upper_dm_plex_box_faces 3,3,2 -lower_dm_plex_box_faces 2,2,2"),
    "shells in space": ("shells3d", "-outer_dm_plex_box_faces 2,2,2 -inner_dm_plex_box_faces 2,2,2"),
    "tied in space": ("patch3d", "-upper_dm_plex_box_faces 2,2,2 -lower_dm_plex_box_faces 2,2,2 -upper_bc_displacement_top 0,0,-1.5e-3 -joint_type tied"),
    "spherical gap in space, order 1": ("spherical_gap", "-upper_dm_plex_box_faces 3,3,2 -lower_dm_plex_box_faces 2,2,2 -order 1"),
    "shells in space, order 1": ("shells3d", "-outer_dm_plex_box_faces 2,2,2 -inner_dm_plex_box_faces 2,2,2 -order 1"),
    "indentation in space, order 1": ("indentation", "-block_dm_plex_box_faces 4,4,3 -order 1"),
    "friction, block": ("greco", "-block_dm_plex_box_faces 8,8"),
    "friction, block, order 1": ("greco", "-block_dm_plex_box_faces 8,8 -order 1"),
    "friction, incline": ("incline", ""),
    "friction, keystone": ("keystone", ""),
    "friction, two plates": ("two_plates", "-upper_dm_plex_box_faces 3,3 -lower_dm_plex_box_faces 2,2 -joint_friction 0.3"),
    "friction, punch": ("punch", "-punch_friction 0.4"),
    "friction, dent in space": ("indentation", "-dent_friction 0.3"),
    "friction, two discs": ("fretting", "-upper_dm_plex_box_faces 12,5 -lower_dm_plex_box_faces 10,4 -load_steps 1,2,4,5"),
    "friction, around an axis": ("hertz_axisymmetric", "-sphere_dm_plex_box_faces 6,5 -block_dm_plex_box_faces 8,6 -joint_friction 0.1"),
    "friction, press fit": ("pull_off", "-hub_dm_plex_box_faces 4,6 -shaft_dm_plex_box_faces 3,5 -load_steps 0,4,8"),
    "rings, kept": ("rings", f"{RINGS} -order 2 -adapt_cells kept"),
    "tied rings": ("../tests/adapt/tied_rings", ""),
    "tied rings, kept": ("../tests/adapt/tied_rings", "-adapt_cells kept"),
    "annulus, kept": ("../tests/adapt/annulus", "-ring_dm_plex_simplex 0 -adapt_cells kept"),
    "shells around an axis": ("shells", RINGS),
    "shells around an axis, kept": ("shells", f"{RINGS} -adapt_cells kept"),
    "shells in space, kept": ("shells3d", "-outer_dm_plex_box_faces 2,2,2 -inner_dm_plex_box_faces 2,2,2 -adapt_cells kept"),
    "rings in space, from a file": ("../tests/adapt/rings3d", "-order 2 -adapt_cells kept"),
    "hertz in space, order 1": ("hertz3d", "-sphere_dm_plex_box_faces 3,3,2 -block_dm_plex_box_faces 4,4,2 -order 1"),
}
# scene -> body and place of a probe, where the options file has none
PROBES = {
    "half space edge": ("upper", "0.5,0.4"),
    "overhang": ("block", "0.3,0.6"),
    "anisotropic": ("board", "0,-2"),
    "hertz2d, order 1": ("block", "0,-0.5"),
    "roller": ("roller", "0.3,-0.6"),
    "indentation in space": ("block", "0.2,0.3,-0.5"),
    "indentation in space, order 1": ("block", "0.2,0.3,-0.5"),
    "parabola": ("block", "0,-0.1"),
    "stack": ("second", "0.5,1.5"),
    "three bodies": ("middle", "1.7,1.7"),
    "dent around an axis": ("block", "1,-0.2"),
    "hertz around an axis": ("block", "0.5,-1"),
    "friction, block": ("block", "0.02,0.02"),
    "friction, incline": ("block", "1,0.5"),
    "friction, keystone": ("wedge", "0.3,0.5"),
    "friction, two discs": ("lower", "1,-2"),
    "friction, press fit": ("hub", "25,15"),
}
# scene -> numbers that are known: closed forms, of two plates an independent solution of high order (uncertain by 9e-5 and 2e-2)
EXACT = {
    "two plates": {("energy", "potential"): -5918.26337, ("pairs", "joint", "normal_force"): 1836995.08},
    "two plates, order 1": {("energy", "potential"): -5918.26337, ("pairs", "joint", "normal_force"): 1836995.08},
    "shells in space, kept": {("pairs", "fit", "mean_pressure"): 0.450005184, ("pairs", "fit", "max_pressure"): 0.450005184},
    **dict.fromkeys(["tight plates", "tight plates, kept", "tight plates, kept, order 1"], {("energy", "potential"): -4587.4452}),
    "half space edge": {("pairs", "joint", "normal_force"): 2e6 / 3, ("pairs", "joint", "max_pressure"): 1e6},
    "rings": {("pairs", "fit", "mean_pressure"): 0.192374956278, ("pairs", "fit", "max_pressure"): 0.192374956278},
    "shells in space": {("pairs", "fit", "mean_pressure"): 0.450005184, ("pairs", "fit", "max_pressure"): 0.450005184},
    "shells in space, order 1": {("pairs", "fit", "mean_pressure"): 0.450005184, ("pairs", "fit", "max_pressure"): 0.450005184},
}
KINDS = {
    "reactions": "reactions",
    "energy": "energies",
    "displacement": "displacements",
    "centre_of_pressure": "places",
    "extent": "places",
    "area": "areas",
    "mean_pressure": "mean pressures",
    "max_pressure": "largest pressures",
    "max_pressure_covered": "largest pressures",
    "max_slip": "slips and dissipation",
    "dissipation": "slips and dissipation",
    "probes": "stresses",
}
# words in the names of scenes -> class; a scene is in each that fits, or in the last one
CLASSES = {
    "around an axis": ("around an axis", "press fit"),
    "in space": ("in space",),
    "curved sides": ("rings", "annulus", "shells", "hertz", "discs", "roller", "gears", "hub", "thermal fit", "spherical"),
    "from files": ("punch", "hertz2d", "half discs", "gears", "lined hub", "from a file"),
    "obstacles": ("punch", "roller", "indentation", "parabola", "block", "incline", "keystone", "dent"),
    "ties": ("tied",),
    "kept": ("kept",),
    "others": (),
}
SECONDS = 1800  # of one run, on a busy machine
# words in names of scenes -> unknowns of the truth, meshes that it has more than those that are judged
TRUTHS = {"tied in space": (1.5e5, 2), "in space": (4e4, 1), "gears": (1.5e5, 2), "half discs": (1.5e5, 2), "hertz2d": (2e5, 3),
          "punch": (8e4, 2), "hub": (1.5e5, 3), "seal": (4e4, 3), "dent around": (8e4, 3), "": (2.5e4, 4)}
FIRST, MANY = 3, 60  # fewest meshes that are judged; meshes of the truth at most


def truth_of(scene):
    return next(truth for words, truth in TRUTHS.items() if words in scene)


def probe(scene):
    if scene not in PROBES:
        return []
    body, place = PROBES[scene]
    return ["-probes", "p", "-probe_p_body", body, "-probe_p_at", place]


def solve(program, scene, meshes, folder):
    name, arguments = SCENES[scene]
    file = folder / f"{scene.replace(' ', '_')}_{meshes}.json"
    if file.is_file():
        return json.loads(file.read_text())
    done = subprocess.run([program, "-options_file", f"{name}.opts", *arguments.split(), *probe(scene), "-adapt", "1e-7", "-adapt_max_meshes", str(meshes), "-quiet",
                           "-adapt_max_unknowns", str(truth_of(scene)[0]), "-summary", file], cwd=OPTIONS, capture_output=True, text=True, check=False, timeout=SECONDS)
    if not file.is_file():
        print(f"  {scene}, {meshes} meshes: {done.stderr.strip()}")
        return None
    return json.loads(file.read_text())


def numbers(bars, summary, truth, limits, path=()):
    """Of each bar: its path, the number, the truth, the half widths of both, the size of its vector, or of the largest reaction."""
    largest = max((abs(x) for side in truth.values() for x in side), default=0) if path == ("reactions",) else 0
    for key, bar in bars.items():
        if key == "unbounded":
            continue
        value, true, limit = summary.get(key), truth.get(key), limits.get(key)
        if isinstance(bar, dict):
            yield from numbers(bar, value, true, limit, (*path, key))
            continue
        lists = [x if isinstance(x, list) else [x] for x in (bar, value, true, limit)]
        size = max(largest, math.sqrt(sum(x * x for x in lists[2] if x is not None)))
        for half, q, t, limit in zip(*lists):
            if None not in (half, q, t, limit) and key != "min_gap":  # zero in contact
                yield (*path, key), q, t, half, limit, size


def numbers_of_steps(summary, truth):
    """Of each load step, or of a scene without."""
    for step, best in zip(summary.get("steps") or [summary], truth.get("steps") or [truth]):
        yield from numbers(step["bars"], step, best, best["bars"], (f"t={step['t']}",) if "t" in step else ())


def kind(path):
    return next((name for key, name in KINDS.items() if key in path), "forces")


def classes(scene):
    names = [name for name, words in CLASSES.items() if any(word in scene for word in words)]
    return names or ["others"]


def judge(program, scene, folder, part):
    """Prints the misses of a scene. Returns for each bar that is judged its kind, whether it holds, and its ratio to the error; how many are not judged; unknowns of the truth."""
    finer = scene.removesuffix(", order 1")
    finer = finer if finer in SCENES else scene
    truth = solve(program, finer, MANY, folder)
    if not truth or not truth["bars"]:
        return [], 0, 0
    best = truth["estimate"]
    bars, unclear, effectivity, bad = [], 0, [], []
    for num in range(FIRST, (len(best["meshes"]) if finer == scene else MANY) - truth_of(scene)[1] + 1):
        summary = solve(program, scene, num, folder)
        if finer != scene and summary and summary["estimate"]["meshes"][-1]["unknowns"] > best["meshes"][-1]["unknowns"] / 4:
            break
        if not summary or not summary["bars"] or len(summary["estimate"]["meshes"]) < num:
            continue
        squared = 2 * (summary["energy"]["potential"] - (best["potential"]["value"] or math.inf))
        if squared > 0:  # with friction there is no energy to tell
            effectivity.append(summary["estimate"]["energy_norm"] / math.sqrt(squared))
        for path, value, true, half, limit, size in numbers_of_steps(summary, truth):
            known = EXACT.get(scene, {}).get(path)
            true, limit = (true, limit) if known is None else (known, 0)
            error = abs(value - true)
            if error <= ROUNDING * size:
                continue
            if limit > part * half and error <= half + limit:
                unclear += 1
                continue
            bars.append((kind(path), error <= half, half / error))
            if error > half:
                bad.append(f"{num}:{'.'.join(path)} {value:.6g} +- {half:.2g}, true {true:.6g} +- {limit:.2g}")
    unknowns = best["meshes"][-1]["unknowns"]
    print(f"{scene}: effectivity {', '.join(f'{e:.2f}' for e in effectivity)}; {unknowns} unknowns in the end")
    for line in bad:
        print("    " + line)
    sys.stdout.flush()
    return bars, unclear, unknowns


def table_of_scenes(found, sizes):
    """Of each scene the unknowns of its truth, and of each kind: bars, misses in brackets where there are any, median ratio of bar and error."""
    kinds = sorted({name for bars in found.values() for name, *_ in bars})
    print(f"\n| scene | truth | {' | '.join(kinds)} | all |\n|---|---:{'|---:' * len(kinds)}|---:|")
    for scene, bars in found.items():
        cells = []
        for name in [*kinds, None]:
            some = [bar for bar in bars if name in (None, bar[0])]
            misses = sum(not holds for _, holds, _ in some)
            cells.append(f"{len(some)}{f' ({misses})' if misses else ''}, {statistics.median(ratio for *_, ratio in some):.2g}" if some else "")
        print(f"| {scene} | {sizes[scene]} | {' | '.join(cells)} |")


def table_of_kinds(found):
    """Of each kind of number, of each class of scene, and of all."""
    groups = {}
    for scene, bars in found.items():
        for bar in bars:
            for name in (bar[0], *classes(scene), "all"):
                groups.setdefault(name, []).append((scene, bar))
    print("\n| kind, class | scenes | bars | misses | hold | median bar / error |\n|---|---:|---:|---:|---:|---:|")
    for name in sorted(groups, key=lambda name: (name == "all", name in CLASSES, name)):
        bars = [bar for _, bar in groups[name]]
        misses = sum(not holds for _, holds, _ in bars)
        print(f"| {name} | {len({scene for scene, _ in groups[name]})} | {len(bars)} | {misses} | {100 - 100 * misses / len(bars):.1f} % "
              f"| {statistics.median(ratio for *_, ratio in bars):.2g} |")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("scene", nargs="*")
    parser.add_argument("--part", type=float, default=0.1)
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_intermixed_args()
    found, sizes, unclear = {}, {}, 0
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scene or SCENES:
            bars, more, sizes[scene] = judge(options.program.resolve(), scene, (options.keep or pathlib.Path(folder)).resolve(), options.part)
            unclear += more
            if bars:
                found[scene] = bars
    table_of_scenes(found, sizes)
    table_of_kinds(found)
    print(f"\n{len(found)} scenes; not judged, since the truth is not known well enough: {unclear}")


if __name__ == "__main__":
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    main()
