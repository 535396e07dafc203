#!/usr/bin/env python3
"""What contact costs, beside one linear solve, by size, by ranks and by error: tables, charts, and what was aimed at.

    python3 tests/bench/scaling.py build/mortise --output build/scaling                  everything: some ten minutes on an idle machine
    python3 tests/bench/scaling.py build/mortise --output build/scaling --quick          up to 3e5 unknowns in the plane, once: two minutes
    python3 tests/bench/scaling.py --output build/scaling --again                        tables and charts of what was measured before
        [--scenes plates,blocks] [--largest 3e5] [--runs 3] [--parts cost,ranks,cross,accuracy,files] [--readme tests/bench/README.md ...] [-- option of mortise ...]

Whole program, no output files, one thread for each process. Runs are interleaved: every case once, then every case again, so that a
machine that changes its speed does it to all of them; figures are medians of --runs runs, of cases beyond 4e5 unknowns of one. CPU seconds and memory
are the operating system's account (memory on several ranks: the program's), stages the program's wall clock. What a linear
solve costs is measured in runs of its own (-measure_linear), which count nowhere else.

With --readme, what stands in these files between <!-- bench:figures --> or <!-- bench:tables --> and <!-- bench:end --> is replaced.
"""
import argparse
import collections
import concurrent.futures
import datetime
import json
import math
import os
import platform
import re
import statistics
import sys
import tempfile

from cases import BALL, CROSS, EQUAL, EXACT, SCENES, SOLVER, SPEED, knows, mesh_ball, run_once, size_of, unknowns
from charts import draw
from figures import STAGES, sections

PARTS = ["cost", "ranks", "cross", "accuracy", "files"]
ONCE_FROM = 4e5  # unknowns from which a case is run once
STOP = ["-stop", "discretisation"]


def say(words):
    print(words, file=sys.stderr, flush=True)


class Bench:
    """Runs cases by the program, and keeps what they gave."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.stops = knows(arguments.program, STOP[0])

    def run(self, scene, size, more=(), ranks=1):
        done = run_once(self.arguments.program, SCENES[scene].file, SOLVER + size.options + list(more) + self.arguments.rest, ranks)
        if done:
            say(f"{SCENES[scene].words} {size.name} on {ranks} {' '.join(more)}: {done[0]:.2f} s")
        return done

    def wants(self, scene, size):
        quick = self.arguments.quick and size.unknowns > (3.2e5 if SCENES[scene].dim == 2 else 1e5)
        return scene in self.arguments.scenes and size.unknowns <= self.arguments.largest and not quick

    def turns(self, cases, more_of=()):
        """All runs of all cases, interleaved: lists of results by (case, what is added to its options)."""
        results = collections.defaultdict(list)
        for turn in range(self.arguments.runs):
            for scene, size, ranks, more in cases:
                key = (scene, size.name, ranks, more)
                once = size.unknowns > ONCE_FROM and key not in more_of
                if turn and (once or len(results[key]) < turn):
                    continue  # enough of it, or it failed
                done = self.run(scene, size, more, ranks)
                if done:
                    results[key].append(done)
        return results

    def cost(self):
        cases = [(scene, size) for scene in self.arguments.scenes for size in SCENES[scene].sizes if self.wants(scene, size)]
        added = [(), ("-measure_linear",)] + ([tuple(STOP)] if self.stops else [])
        results = self.turns([(scene, size, 1, more) for scene, size in cases for more in added if more != tuple(STOP) or SCENES[scene].levels])
        return [medians(scene, size, *(results[(scene, size.name, 1, more)] for more in (added + [None])[:3]))
                for scene, size in cases if results[(scene, size.name, 1, ())]]

    def ranks(self):
        def rows(named, counts, timed):
            cases = [(scene, size_of(scene, name), ranks, ()) for scene, name in named if self.wants(scene, size_of(scene, name)) for ranks in counts]
            results = self.turns(cases, {(scene, size.name, ranks, more) for scene, size, ranks, more in cases} if timed else ())
            return [on_ranks(scene, size, ranks, timed, results[(scene, size.name, ranks, more)]) for scene, size, ranks, more in cases
                    if results[(scene, size.name, ranks, more)]]
        timed = rows(SPEED, (1, 2), True)
        for row in timed:
            if row["ranks"] == 1:
                row["beside"] = self.beside(row["scene"], size_of(row["scene"], row["size"]))
        runs, self.arguments.runs = self.arguments.runs, 1
        equal = rows(EQUAL, (1, 2, 4) if self.arguments.quick else (1, 2, 4, 8), False)
        self.arguments.runs = runs
        return timed + equal

    def beside(self, scene, size):
        """Wall seconds of one of two runs at the same time that have nothing to do with each other. What one does to the other is the machine's."""
        seconds = []
        for _ in range(self.arguments.runs):
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                both = list(pool.map(lambda _: self.run(scene, size), range(2)))
            seconds += [done[2]["timing"]["total"] for done in both if done]
        return statistics.median(seconds) if seconds else None

    def cross(self):
        rows = []
        for scene, name in CROSS:
            if self.wants(scene, size_of(scene, name)):
                alone, done = (self.run(scene, size_of(scene, name), more) for more in ((), ("-cross_check",)))
                check = done and done[2]["solver"]["cross_check"]
                if alone and check:
                    rows.append({"scene": scene, "unknowns": unknowns(done[2]), "difference": check["displacement_difference"],
                                 "active": check["active_difference"], "linear": check["linear"],
                                 "steps": (alone[2]["solver"]["iterations"], check["iterations"]), "cpu": (alone[0], done[0]),
                                 "work": (alone[2]["solver"]["work_units"], check["work_units"]), "megabytes": (alone[1], done[1])})
        return rows

    def accuracy(self):
        rows = []
        for solver, words in (("cholesky", "direct"), ("truncatedmg", "multigrid")):
            levels = "5" if self.arguments.quick else "6"
            options = EXACT[1] + ["-study", "uniform", "-study_levels", levels, "-study_orders", "1,2", "-pc_type", solver] + self.arguments.rest
            done = run_once(self.arguments.program, EXACT[0], options)
            if done:
                say(f"study with {words} solver: {done[0]:.2f} s")
                rows += [{"order": run["order"], "solver": words, "unknowns": run["unknowns"], "error": run["energy_error_relative"],
                          "cpu": run["seconds_processor"], "megabytes": run["peak_bytes"] / 2**20} for run in done[2]["study"]["runs"]]
        return rows

    def files(self):
        rows = []
        for order, size, about, factored in BALL:
            if about > self.arguments.largest or (self.arguments.quick and about > 1e5):
                continue
            with tempfile.TemporaryDirectory() as folder:
                scene = mesh_ball(folder, order, size)
                if not scene:
                    say("no Gmsh: nothing is said of meshes from files")
                    break
                for solver, words in (("truncatedmg", "multigrid"), ("cholesky", "direct"))[: 2 if factored else 1]:
                    options = scene[1] + ["-pc_type", solver] + self.arguments.rest
                    results = [done for done in (run_once(self.arguments.program, scene[0], options) for _ in range(self.arguments.runs)) if done]
                    if results:
                        found = results[0][2]["solver"]
                        rows.append({"order": order, "solver": words, "unknowns": unknowns(results[0][2]), "steps": found["iterations"],
                                     "iterations": found["linear_iterations"] if solver == SOLVER[1] else None, "work": found["work_units"] or None,
                                     "cpu": statistics.median(run[0] for run in results), "megabytes": statistics.median(run[1] for run in results)})
                        say(f"ball on block of order {order}, {rows[-1]['unknowns']} unknowns, {words}: {rows[-1]['cpu']:.2f} s")
        return rows


def medians(scene, size, plain, beside, stopped):
    summary = plain[0][2]
    solver, reference = summary["solver"], beside[0][2]["solver"]["linear_reference"] if beside else None
    return {
        "scene": scene, "size": size.name, "runs": len(plain), "unknowns": unknowns(summary),
        "cpu": statistics.median(run[0] for run in plain), "wall": statistics.median(run[2]["timing"]["total"] for run in plain),
        "megabytes": statistics.median(run[1] for run in plain),
        "steps": solver["iterations"], "iterations": solver["linear_iterations"], "work": solver["work_units"],
        "one_iterations": reference and reference["iterations"], "one_work": reference and reference["work_units"],
        "ratio": statistics.median(run[2]["solver"]["linear_reference"]["contact_ratio"] for run in beside) if reference else None,
        "seconds": {stage: statistics.median(run[2]["timing"][stage] for run in plain) for stage in STAGES},
        "stopped_work": stopped[0][2]["solver"]["work_units"] if stopped else None,
        "stopped_cpu": statistics.median(run[0] for run in stopped) if stopped else None,
    }


def on_ranks(scene, size, ranks, timed, results):
    summary = results[0][2]
    return {
        "scene": scene, "size": size.name, "ranks": ranks, "timed": timed, "runs": len(results), "unknowns": unknowns(summary),
        "steps": summary["solver"]["iterations"], "iterations": summary["solver"]["linear_iterations"], "work": summary["solver"]["work_units"],
        "wall": statistics.median(run[2]["timing"]["total"] for run in results), "cpu": statistics.median(run[0] for run in results),
        "megabytes": statistics.median(run[1] for run in results), "largest": summary["memory"]["largest_rank_bytes"] / 2**20,
    }


def machine():
    """The processor in words, and how many of them."""
    model = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            model = next((line.split(":", 1)[1].strip() for line in file if line.startswith("model name")), model)
    except OSError:
        pass
    return f"{model}, {os.cpu_count()} cores"


def measure(arguments):
    bench = Bench(arguments)
    load = os.getloadavg()[0]
    found = {"machine": machine(), "cores": os.cpu_count(), "date": str(datetime.date.today()), "options": arguments.rest, "quick": arguments.quick}
    found["rows"] = bench.cost() if "cost" in arguments.parts else []
    for part in PARTS[1:]:
        found[part] = getattr(bench, part)() if part in arguments.parts else []
    found["load"] = [load, os.getloadavg()[0]]
    return found


def replace(file, texts):
    """Puts texts into their places in a file."""
    with open(file, encoding="utf-8") as stream:
        text = stream.read()
    for name, new in texts.items():
        text = re.sub(f"(<!-- bench:{name} -->\n).*?(<!-- bench:end -->)", lambda match, new=new: match[1] + new + match[2], text, flags=re.S)
    with open(file, "w", encoding="utf-8") as stream:
        stream.write(text)


def names(known):
    def read(text):
        wanted = text.split(",")
        for name in wanted:
            if name not in known:
                raise argparse.ArgumentTypeError(f"{name}: must be of {', '.join(known)}")
        return wanted
    return read


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("--output", required=True, help="folder for tables.md, cost.svg, shares.svg, accuracy.svg and runs.json")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--scenes", type=names(SCENES), default=list(SCENES))
    parser.add_argument("--parts", type=names(PARTS), default=PARTS)
    parser.add_argument("--largest", type=float, default=math.inf, help="unknowns of the largest case")
    parser.add_argument("--runs", type=int)
    parser.add_argument("--readme", nargs="*", default=[])
    parser.add_argument("--again", action="store_true", help="nothing is measured; needs runs.json")
    end = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    arguments = parser.parse_args(sys.argv[1:end])
    arguments.rest, arguments.runs = sys.argv[end + 1 :], arguments.runs or (1 if arguments.quick else 3)
    raw = os.path.join(arguments.output, "runs.json")
    os.makedirs(arguments.output, exist_ok=True)
    if not arguments.again:
        if not arguments.program:
            parser.error("which program?")
        found = measure(arguments)
        with open(raw, "w", encoding="utf-8") as file:
            json.dump(found, file, indent=1)
    with open(raw, encoding="utf-8") as file:
        found = json.load(file)
    texts = sections(found)
    with open(os.path.join(arguments.output, "tables.md"), "w", encoding="utf-8") as file:
        file.write(texts["tables"])
    draw(found, arguments.output)
    for file in arguments.readme:
        replace(file, texts)
        if os.path.dirname(os.path.abspath(file)) == os.path.dirname(os.path.abspath(__file__)):
            draw(found, os.path.dirname(file))  # its pictures lie beside it
    print(texts["tables"], end="")


if __name__ == "__main__":
    main()
