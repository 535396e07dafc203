#!/usr/bin/env python3
"""Cost of a load step in first solves: python3 tests/bench/steps.py build/mortise [--runs 3]

For each scene a run of ten steps and one of the first step alone give processor seconds. Other programs on the machine change them little.
A ninth of their difference is a later step. `of all` is that over the first step; `of a solve` is the same over the first step without the
start of the program and the mesh. Later steps never need these. Medians of the runs. Both should be below 0.5."""
import argparse
import json
import os
import pathlib
import resource
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
    """The summary of a run, and its processor seconds. One thread: those of libraries wait for each other in loops."""
    path = pathlib.Path(folder) / "summary.json"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "-options_file", OPTIONS / f"{scene}.opts", "-summary", path, "-quiet", *options], check=True,
                   env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_THREAD_LIMIT": "1"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return json.loads(path.read_text()), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(program, scene, options, folder):
    """Seconds of the first step, of its solve alone, and of a later step; unknowns; linear solver; active sets and linear iterations of a step."""
    summary, together = solve(program, scene, [*options, "-load_steps", str(STEPS)], folder)
    alone, first = solve(program, scene, [*options, "-load_steps", f"{1 / STEPS:.3f}"], folder)
    timing = alone["timing"]
    part = sum(timing[key] for key in ("mortar", "assembly", "condense", "solve", "output")) / timing["total"]
    unknowns = sum(body["dofs"] for body in summary["scene"]["bodies"].values())
    counts = [statistics.mean(step[key] for step in summary["steps"][1:]) for key in ("iterations", "linear_iterations")]
    return first, part * first, (together - first) / (STEPS - 1), unknowns, *counts


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    program = arguments.program.resolve()
    print("| scene | unknowns | first step, s | later step, s | active sets | CG | of all | of a solve | below 0.5 |\n|---|---:|---:|---:|---:|---:|---:|---:|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, scene, options in SCENES:
            runs = [measure(program, scene, options, folder) for _ in range(arguments.runs)]
            first, later = (statistics.median(run[k] for run in runs) for k in (0, 2))
            of_all, of_solve = (statistics.median(run[2] / run[k] for run in runs) for k in (0, 1))
            print(f"| {name} | {runs[0][3]} | {first:.2f} | {later:.2f} | {runs[0][4]:.1f} | {runs[0][5]:.1f} | {of_all:.2f} | {of_solve:.2f} | {'yes' if of_solve < LIMIT else '**no**'} |", flush=True)


if __name__ == "__main__":
    main()
