#!/usr/bin/env python3
"""Stages as multiples of the time that their bytes take at the speed of memory.

    cmake --build build --target bench_stream
    python3 tests/bench/bytes.py build/mortise build/tests/bench_stream

A stage must read what it is given once and write what it makes once; a product with K reads K once. Boxes of order 1 on all levels, N nodes on
the finest one, d dimensions, 3^d neighbours of a node, itself included. On all levels together there are N / (1 - 2^-d) nodes:

* setup writes coordinates, 8 d bytes of a node, and the table of cells, 4 2^d of a cell;
* assembly writes K of all levels with a column for each entry: 12 bytes of each of d^2 3^d entries of a node;
* condense reads K and writes its upper triangle in blocks: 8 d^2 + 4 bytes of each of (3^d + 1)/2 blocks of a node;
* solve makes as many products as it has work units; each reads those blocks, reads x, reads and writes y;
* output makes one product with K.

Mortar works on sides, which are small. Seconds are those of the processor.
"""
import statistics
import subprocess
import sys

import cases

RUNS = 3
STAGES = ("setup", "assembly", "condense", "solve", "output")
SCENES = [("plates", "576:448"), ("blocks", "40:32")]


def bytes_of_stages(dim, nodes, work):
    levels, neighbours = 1 / (1 - 2.0**-dim), 3**dim
    assembled, blocks = 12 * dim**2 * neighbours, (8 * dim**2 + 4) * (neighbours + 1) / 2
    return {"setup": nodes * levels * (8 * dim + 4 * 2**dim), "assembly": nodes * levels * assembled,
            "condense": nodes * levels * (assembled + blocks), "solve": nodes * work * (blocks + 3 * 8 * dim), "output": nodes * (assembled + 3 * 8 * dim)}


def measure(program, scene, size):
    """Median processor seconds of each stage, unknowns, and work units. The processor works all the time: a stage has its share of the seconds."""
    runs = [cases.run_once(program, cases.SCENES[scene].file, cases.SOLVER + size.options) for _ in range(RUNS)]
    seconds = {stage: statistics.median(found["timing"][stage] / found["timing"]["total"] * cpu for cpu, _, found in runs) for stage in STAGES}
    return seconds, cases.unknowns(runs[0][2]), runs[0][2]["solver"]["work_units"]


def main():
    program, stream = sys.argv[1:3]
    speed = statistics.median(float(subprocess.run([stream], capture_output=True, text=True, check=True).stdout.split()[0]) for _ in range(RUNS))
    print(f"Triad of one core: {speed / 1e9:.1f} GB/s.\n")
    print("| scene | unknowns | stage | seconds | GB that it must move | times slower than memory |\n|---|---:|---|---:|---:|---:|")
    for scene, name in SCENES:
        dim = cases.SCENES[scene].dim
        seconds, unknowns, work = measure(program, scene, cases.size_of(scene, name))
        for stage, count in bytes_of_stages(dim, unknowns / dim, work).items():
            print(f"| {cases.SCENES[scene].words} | {unknowns} | {stage} | {seconds[stage]:.2f} | {count / 1e9:.2f} | {seconds[stage] * speed / count:.1f} |")


if __name__ == "__main__":
    main()
