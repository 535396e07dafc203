#!/usr/bin/env python3
"""Cost of a contact solution against the number of unknowns: the two plates of options/two_plates.opts with the direct solver.

    python3 tests/bench/bench.py build/mortise [--sizes 32,64,128] [--runs 5] [--simplex] [--match] [-- option of mortise ...]
    python3 tests/bench/bench.py build/tests/bench_search --search [--sizes 32,64,128,256] [--ranks 1,2,4] [-- option ...]

Whole program, one core, no output files. Every figure is the median of the runs; the table is Markdown on stdout. CPU seconds
and peak memory are the operating system's account of the finished process; the stages are the program's own wall clock.

With --search: the search for partners alone, between two sheets bent in space (sheets.opts), by the program of search.c
(cmake --build build --target bench_search).
"""
import argparse
import math
import os
import statistics
import subprocess
import sys

from cases import run_once

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, "..", "..", "options", "two_plates.opts")
SHEETS = os.path.join(HERE, "sheets.opts")
SEARCH = ["n", "ranks", "nonmortar", "mortar", "found each", "exchange ms", "query ms", "ns / (N log N)", "of the pair %", "held", "MB", "resident MB"]
STAGES = ["setup", "mortar", "assembly", "condense", "solve", "output"]


def run_plates(program, options):
    """Runs the program once; returns (CPU seconds, peak MB, summary)."""
    return run_once(program, SCENE, options) or sys.exit("bench: a run that does not end well has no cost")


def size_options(n, arguments):
    """n x n cells in the upper plate against 3n/4 in the lower one (or n with --match)."""
    m = n if arguments.match else 3 * n // 4
    options = ["-upper_dm_plex_box_faces", f"{n},{n}", "-lower_dm_plex_box_faces", f"{m},{m}"]
    if arguments.simplex:
        options += ["-upper_dm_plex_simplex", "1", "-lower_dm_plex_simplex", "1"]
    return options + arguments.rest


def row(program, n, arguments):
    """One line of the table: medians over the runs after one warm-up."""
    options = size_options(n, arguments)
    run_plates(program, options)
    runs = [run_plates(program, options) for _ in range(arguments.runs)]
    summary = runs[0][2]
    unknowns = sum(body["dofs"] for body in summary["scene"]["bodies"].values())
    total = statistics.median(r[2]["timing"]["total"] for r in runs)
    shares = [100 * statistics.median(r[2]["timing"][stage] for r in runs) / total for stage in STAGES]
    cells = [n, unknowns, summary["solver"]["iterations"], f"{statistics.median(r[0] for r in runs):.2f}",
             f"{total:.2f}", f"{statistics.median(r[1] for r in runs):.0f}"] + [f"{s:.1f}" for s in shares]
    return "| " + " | ".join(str(c) for c in cells) + " |"


def search(program, n, ranks, arguments):
    """One line about the search: n x n facets above, 3n/4 x 3n/4 below."""
    m = 3 * n // 4
    options = ["-upper_dm_plex_box_faces", f"{n},{n},1", "-lower_dm_plex_box_faces", f"{m},{m},1"] + arguments.rest
    launcher = ["mpiexec", "-n", str(ranks)] if ranks > 1 else []
    command = launcher + [program, "-options_file", SHEETS] + options
    words = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    found = dict(zip(words[::2], map(float, words[1::2])))
    work = found["nonmortar"] + found["mortar"]
    seconds = found["exchange"] + found["query"]
    cells = [n, ranks, int(found["nonmortar"]), int(found["mortar"]), f"{found['hits'] / found['nonmortar']:.2f}",
             f"{1e3 * found['exchange']:.1f}", f"{1e3 * found['query']:.1f}", f"{1e9 * seconds / (work * math.log2(work)):.0f}",
             f"{100 * seconds / found['pair']:.1f}", int(found["held"]), f"{found['megabytes']:.2f}", f"{found['resident']:.0f}"]
    return "| " + " | ".join(str(c) for c in cells) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--sizes", default="32,64,128")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--simplex", action="store_true", help="triangles instead of quads")
    parser.add_argument("--match", action="store_true", help="the same mesh on both sides")
    parser.add_argument("--search", action="store_true", help="the search for partners alone")
    parser.add_argument("--ranks", default="1", help="with --search")
    end = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    arguments = parser.parse_args(sys.argv[1:end])
    arguments.rest = sys.argv[end + 1 :]
    header = SEARCH if arguments.search else ["n", "unknowns", "steps", "CPU s", "wall s", "MB"] + [f"{s} %" for s in STAGES]
    print("| " + " | ".join(header) + " |")
    print("|" + "---:|" * len(header))
    for n in (int(s) for s in arguments.sizes.split(",")):
        if not arguments.search:
            print(row(arguments.program, n, arguments), flush=True)
            continue
        for ranks in (int(r) for r in arguments.ranks.split(",")):
            print(search(arguments.program, n, ranks, arguments), flush=True)


if __name__ == "__main__":
    main()
