#!/usr/bin/env python3
"""Cost of a load step in first solves: python3 tests/bench/steps.py build/mortise [--runs 3]

For each scene one run of ten steps gives the seconds of every step, from its beginning to its certificate. The first step is a whole solve.
`of all` is the median of the later steps over the first step; `of a solve` is the same over the first step without the start of the
program and the mesh, which later steps never need. A run of the first step alone tells their part. Medians of the runs. Both should be below 0.5."""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import tempfile

OPTIONS = pathlib.Path(__file__).resolve().parents[2] / "options"
STEPS = 10
LIMIT = 0.5
SCENES = [  # name, scene, options
    ("disc on block", "hertz2d", []),
    ("sphere on block, axisymmetric, order 2", "hertz_axisymmetric", []),
    ("sphere on block in space, order 2", "hertz3d", []),
    ("floating block", "overhang", []),
    ("two plates, multigrid", "two_plates", ["-upper_dm_plex_box_faces", "45,45", "-lower_dm_plex_box_faces", "35,35", "-dm_refine", "3"]),
    ("disc on block, multigrid", "hertz2d", ["-dm_refine", "2", "-pc_type", "truncatedmg"]),
    ("sphere on block in space, multigrid", "hertz3d", ["-order", "1", "-dm_refine", "2"]),
]


def solve(program, scene, options, folder):
    path = pathlib.Path(folder) / "summary.json"
    subprocess.run([program, "-options_file", OPTIONS / f"{scene}.opts", "-summary", path, "-quiet", *options], check=True,
                   env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"})
    return json.loads(path.read_text())


def measure(program, scene, options, folder):
    """Seconds of the first step, of its solve alone, and of a later step; unknowns."""
    summary = solve(program, scene, [*options, "-load_steps", str(STEPS)], folder)
    alone = solve(program, scene, [*options, "-load_steps", f"{1 / STEPS:.3f}"], folder)
    seconds = [step["seconds"] for step in summary["steps"]]
    timing = alone["timing"]
    part = sum(timing[key] for key in ("mortar", "assembly", "condense", "solve", "output")) / timing["total"]
    unknowns = sum(body["dofs"] for body in summary["scene"]["bodies"].values())
    return seconds[0], part * seconds[0], statistics.median(seconds[1:]), unknowns, summary["solver"]["linear"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    program = arguments.program.resolve()
    print("| scene | unknowns | first step, s | later step, s | of all | of a solve | below 0.5 |\n|---|---:|---:|---:|---:|---:|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, scene, options in SCENES:
            runs = [measure(program, scene, options, folder) for _ in range(arguments.runs)]
            first, later = (statistics.median(run[k] for run in runs) for k in (0, 2))
            of_all, of_solve = (statistics.median(run[2] / run[k] for run in runs) for k in (0, 1))
            print(f"| {name} | {runs[0][3]} | {first:.2f} | {later:.2f} | {of_all:.2f} | {of_solve:.2f} | {'yes' if of_solve < LIMIT else '**no**'} |", flush=True)


if __name__ == "__main__":
    main()
