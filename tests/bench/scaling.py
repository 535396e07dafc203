#!/usr/bin/env python3
"""Cost of contact against the number of unknowns, beside what one linear solve costs: table and plots.

    python3 tests/bench/scaling.py build/mortise --output build/scaling [--largest 3e5] [--scenes plates,blocks] [--ranks 1,2] [--runs 5]
                                                 [-- option of mortise ...]
    python3 tests/bench/scaling.py --output build/scaling --again         plots and table of what was measured before

Whole program, no output files, one thread for each process. Runs are interleaved: every case once, then every case again, so that a
machine that changes its speed does it to all of them; figures are medians. CPU seconds and memory are the operating system's account
(memory on several ranks: the program's, of all together), stages the program's wall clock. What a linear solve costs is
measured in runs of its own (-measure_linear), which count nowhere else.
"""
import argparse
import collections
import datetime
import json
import math
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import threading

HERE = os.path.dirname(os.path.abspath(__file__))
OPTIONS = os.path.join(HERE, "..", "..", "options")
STAGES = ["setup", "mortar", "assembly", "condense", "solve", "output"]
LIMIT = 900  # seconds that a run may take
SOLVER = ["-pc_type", "truncatedmg"]

Scene = collections.namedtuple("Scene", "words file levels slope_from")  # levels: (name, options, unknowns about) of every size


def boxes(upper, lower, refine):
    """Cells of the coarse boxes, and how often they are refined."""
    def text(cells):
        return ",".join(str(c) for c in cells)
    return ["-upper_dm_plex_box_faces", text(upper), "-lower_dm_plex_box_faces", text(lower), "-dm_refine", str(refine)]


def plates(coarse_lower):
    levels = []
    for refine in range(3, 7):
        n, m = 8 * 2**refine, coarse_lower * 2**refine
        levels.append((f"{n}:{m}", boxes((8, 8), (coarse_lower, coarse_lower), refine), 2 * ((n + 1) ** 2 + (m + 1) ** 2)))
    return levels


def blocks():
    levels = []
    for upper, lower, refine in ((6, 5, 1), (5, 4, 2), (10, 8, 2), (5, 4, 3), (15, 12, 2)):
        n, m = upper * 2**refine, lower * 2**refine
        levels.append((f"{n}:{m}", boxes((upper,) * 3, (lower,) * 3, refine), 3 * ((n + 1) ** 3 + (m + 1) ** 3)))
    return sorted(levels, key=lambda level: level[2])


def refined(counts, more=()):
    """A scene as it is, refined so many times: unknowns about counts."""
    return [(f"refined {r}", ["-dm_refine", str(r), *more], count) for r, count in counts.items()]


SCENES = {
    "plates": Scene("two plates, n : n", os.path.join(OPTIONS, "two_plates.opts"), plates(8), 6e4),
    "plates34": Scene("two plates, n : 3n/4", os.path.join(OPTIONS, "two_plates.opts"), plates(6), 5e4),
    "blocks": Scene("two blocks, curved gap", os.path.join(HERE, "blocks.opts"), blocks(), 4e4),
    "hertz2d": Scene("hertz2d", os.path.join(OPTIONS, "hertz2d.opts"), refined({1: 5e4, 2: 2e5, 3: 8e5}), 4e4),
    "hertz3d": Scene("hertz3d, order 1", os.path.join(OPTIONS, "hertz3d.opts"), refined({1: 3.2e4, 2: 2.3e5}, ["-order", "1"]), 3e4),
}


def run_once(program, file, options, ranks):
    """Runs the program once; returns (CPU seconds, MB, summary)."""
    with tempfile.TemporaryDirectory() as folder:
        summary = os.path.join(folder, "summary.json")
        launcher = ["mpiexec", "-n", str(ranks)] if ranks > 1 else []
        command = launcher + [program, "-options_file", file, "-quiet", "-summary", summary] + options
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
        process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL)
        alarm = threading.Timer(LIMIT, process.terminate)
        alarm.start()
        _, status, usage = os.wait4(process.pid, 0)
        alarm.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            print(f"scaling: {' '.join(command)} ended with status {process.returncode}", file=sys.stderr)
            return None
        with open(summary, encoding="utf-8") as text:
            found = json.load(text)
        megabytes = usage.ru_maxrss / 1024 if ranks == 1 else found["memory"]["peak_bytes"] / 2**20
        return usage.ru_utime + usage.ru_stime, megabytes, found


def measure(arguments):
    """All runs of all cases, interleaved; a list of dictionaries of medians."""
    cases = [(name, level, ranks) for name in arguments.scenes for level in SCENES[name].levels if level[2] <= arguments.largest
             for ranks in arguments.ranks]
    plain, beside = collections.defaultdict(list), collections.defaultdict(list)
    for turn in range(arguments.runs):
        for case in cases:
            name, (size, options, _), ranks = case
            key = (name, size, ranks)
            if turn and len(plain[key]) < turn:
                continue  # it failed the first time
            common = SOLVER + options + arguments.rest
            done = run_once(arguments.program, SCENES[name].file, common, ranks)
            if not done:
                continue
            plain[key].append(done)
            done = run_once(arguments.program, SCENES[name].file, common + ["-measure_linear"], ranks)
            if done:
                beside[key].append(done)
            print(f"run {turn + 1}: {name} {size} on {ranks}: {plain[key][-1][0]:.2f} s", file=sys.stderr, flush=True)
    return [medians(key, plain[key], beside[key]) for key in plain if plain[key]]


def medians(key, plain, beside):
    summary = plain[0][2]
    solver, reference = summary["solver"], beside[0][2]["solver"]["linear_reference"] if beside else None
    total = statistics.median(run[2]["timing"]["total"] for run in plain)
    return {
        "scene": key[0], "size": key[1], "ranks": key[2], "runs": len(plain),
        "unknowns": sum(body["dofs"] for body in summary["scene"]["bodies"].values()),
        "cpu": statistics.median(run[0] for run in plain), "wall": total, "megabytes": statistics.median(run[1] for run in plain),
        "steps": solver["iterations"], "sets": 1 + sum(1 for change in solver["changed"] or [] if change),
        "iterations": solver["linear_iterations"], "work": solver["work_units"],
        "one_iterations": reference and reference["iterations"], "one_work": reference and reference["work_units"],
        "ratio": statistics.median(run[2]["solver"]["linear_reference"]["contact_ratio"] for run in beside) if reference else None,
        "shares": {stage: statistics.median(run[2]["timing"][stage] for run in plain) / total for stage in STAGES},
    }


def slope(rows):
    """Exponent of CPU seconds against unknowns, by least squares of the logarithms; None of fewer than two sizes."""
    points = [(math.log(row["unknowns"]), math.log(row["cpu"])) for row in rows]
    if len(points) < 2:
        return None
    x, y = (statistics.mean(values) for values in zip(*points))
    return sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)


def exponents(rows):
    """(scene, smallest, largest, exponent) on one rank, of the sizes that count for it."""
    for name, scene in SCENES.items():
        large = sorted((row for row in rows if row["scene"] == name and row["ranks"] == 1 and row["unknowns"] >= scene.slope_from),
                       key=lambda row: row["unknowns"])
        found = slope(large)
        if found is not None:
            yield name, large[0]["unknowns"], large[-1]["unknowns"], found


def number(value, digits=0):
    return "-" if value is None else f"{value:.{digits}f}"


def table(rows):
    header = ["scene", "size", "unknowns", "ranks", "CPU s", "wall s", "MB", "steps", "sets", "CG, all", "CG, one solve", "work units", "of one solve",
              "contact / linear"] + [f"{stage} %" for stage in STAGES]
    lines = ["| " + " | ".join(header) + " |", "|---|" + "---:|" * (len(header) - 1)]
    for row in rows:
        cells = [SCENES[row["scene"]].words, row["size"], row["unknowns"], row["ranks"], number(row["cpu"], 2), number(row["wall"], 2),
                 number(row["megabytes"]), row["steps"], row["sets"], row["iterations"], number(row["one_iterations"]), number(row["work"]),
                 number(row["one_work"]), number(row["ratio"], 2)] + [number(100 * row["shares"][stage], 1) for stage in STAGES]
        lines.append("| " + " | ".join(str(cell) for cell in cells) + " |")
    lines.append("")
    for name, least, most, found in exponents(rows):
        lines.append(f"* {SCENES[name].words}: CPU seconds grow with unknowns to the {found:.2f}, from {least} to {most}")
    for row in rows:
        alone = next((r for r in rows if (r["scene"], r["size"], r["ranks"]) == (row["scene"], row["size"], 1)), None)
        if row["ranks"] > 1 and alone:
            lines.append(f"* {SCENES[row['scene']].words}, {row['unknowns']} unknowns: {row['ranks']} ranks are "
                         f"{alone['wall'] / row['wall']:.2f} times as fast as one")
    return "\n".join(lines) + "\n"


def draw(rows, folder):
    import matplotlib  # pylint: disable=import-outside-toplevel

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "mortise"
    import matplotlib.pyplot as plt  # pylint: disable=import-outside-toplevel

    slopes = {name: found for name, _, _, found in exponents(rows)}
    alone = {name: sorted((r for r in rows if r["scene"] == name and r["ranks"] == 1), key=lambda r: r["unknowns"]) for name in SCENES}
    alone = {name: found for name, found in alone.items() if found}

    def finish(figure, file):
        figure.tight_layout()
        figure.savefig(os.path.join(folder, file), metadata={"Date": None})
        plt.close(figure)

    figure, (cost, ratio) = plt.subplots(1, 2, figsize=(11, 4.5))
    for name, found in alone.items():
        unknowns = [r["unknowns"] for r in found]
        label = SCENES[name].words + (f", to the {slopes[name]:.2f}" if name in slopes else "")
        cost.loglog(unknowns, [r["cpu"] for r in found], "o-", label=label)
        measured = [r for r in found if r["ratio"]]
        ratio.semilogx([r["unknowns"] for r in measured], [r["ratio"] for r in measured], "o-", label=SCENES[name].words)
    cost.set(xlabel="unknowns", ylabel="CPU seconds, whole program")
    ratio.set(xlabel="unknowns", ylabel="contact solve / one linear solve", ylim=(0, None))
    for axes in (cost, ratio):
        axes.grid(True, which="both", alpha=0.3)
        axes.legend(fontsize=8)
    finish(figure, "cost.svg")

    figure, axes = plt.subplots(figsize=(8, 0.7 + 0.5 * len(alone) + 0.8))
    for place, found in enumerate(alone.values()):
        left = 0
        for colour, stage in enumerate(STAGES):
            share = 100 * found[-1]["shares"][stage]
            axes.barh(place, share, left=left, color=f"C{colour}", label=None if place else stage)
            left += share
    axes.set_yticks(range(len(alone)), [f"{SCENES[name].words}\n{found[-1]['unknowns']} unknowns" for name, found in alone.items()], fontsize=8)
    axes.set(xlabel="% of the wall clock", xlim=(0, 100))
    axes.legend(fontsize=8, ncol=len(STAGES), loc="lower center", bbox_to_anchor=(0.5, 1))
    finish(figure, "shares.svg")


def machine():
    """The processor in words, and how many of them."""
    model = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            model = next((line.split(":", 1)[1].strip() for line in file if line.startswith("model name")), model)
    except OSError:
        pass
    return f"{model}, {os.cpu_count()} cores"


def names(known):
    def read(text):
        wanted = text.split(",")
        for name in wanted:
            if name not in known:
                raise argparse.ArgumentTypeError(f"{name}: the scenes are {', '.join(known)}")
        return wanted
    return read


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("--output", required=True, help="folder for table.md, cost.svg, shares.svg and runs.json")
    parser.add_argument("--scenes", type=names(SCENES), default=list(SCENES))
    parser.add_argument("--largest", type=float, default=math.inf, help="unknowns of the largest case")
    parser.add_argument("--ranks", type=lambda text: [int(word) for word in text.split(",")], default=[1, 2])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--again", action="store_true", help="nothing is measured; needs runs.json")
    end = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    arguments = parser.parse_args(sys.argv[1:end])
    arguments.rest = sys.argv[end + 1 :]
    raw = os.path.join(arguments.output, "runs.json")
    os.makedirs(arguments.output, exist_ok=True)
    if not arguments.again:
        if not arguments.program:
            parser.error("which program?")
        rows = measure(arguments)
        with open(raw, "w", encoding="utf-8") as file:
            json.dump({"machine": machine(), "date": str(datetime.date.today()), "options": arguments.rest, "rows": rows}, file, indent=1)
    with open(raw, encoding="utf-8") as file:
        found = json.load(file)
    extra = f", with {' '.join(found['options'])}" if found["options"] else ""
    text = f"{found['machine']}, {found['date']}, medians of {max((r['runs'] for r in found['rows']), default=0)} runs{extra}.\n\n" + table(found["rows"])
    with open(os.path.join(arguments.output, "table.md"), "w", encoding="utf-8") as file:
        file.write(text)
    draw(found["rows"], arguments.output)
    print(text, end="")


if __name__ == "__main__":
    main()
