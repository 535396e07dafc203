#!/usr/bin/env python3
"""judge.py -- runs mortise in an empty folder and judges what it says and writes.

ctest calls this program (see CMakeLists.txt here); a test that judges numbers is a Python file with one function,

    from judge import near

    def judge(run):
        near("force", run.pair("joint")["normal_force"], 2e6, relative=1e-9)

which gets a finished, solved run. Comparisons print the figure that is off and by how much; the first one ends the test.
"""
import argparse
import csv
import fnmatch
import importlib.util
import itertools
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys

LEAK = re.compile(r"^\[ *\d+\] *\d+ bytes .*", re.MULTILINE)  # a line of -malloc_dump
CHECKS = ["-skip_petscrc", "-malloc_dump"]
NAME = "result"  # -output of every run
# A program without mpiexec starts five times faster without Open MPI's daemon, whose folder such programs would share, and has no other rank to
# yield the processor to.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_orte_create_session_dirs": "0", "OMPI_MCA_mpi_yield_when_idle": "0"}
LONG = bool(os.environ.get("MORTISE_TEST_LONG"))  # checks may look at more cases, see README.md
TIMEOUT = 0.8 * int(os.environ.get("MORTISE_TEST_TIMEOUT", 300))  # seconds of one run; longer is a hang


class Failure(Exception):
    """What a test does not like, as a sentence."""


# A line of stderr that warns: of which of several runs, words, code.
WARNING = re.compile(r"mortise: warning: (?P<label>(?:order [12]|own orders), level \d+: |t = [-+0-9.e]+: )?(?P<words>.*) \[(?P<code>\w+)\]")


class Expected:
    """The codes of warnings that the runs of this test have: all that warns.txt of its folder lists for it, each in one run at least."""

    def __init__(self):
        self.codes, self.seen = set(), set()

    def read(self, test):
        """[in] test - <folder>.<name>.np<ranks>; lines of the table are `<code>: <name> ...`, or <name>.np<ranks>, <name>.long for the long run alone,
        * for any letters"""
        folder, name = test.split(".", 1)
        short = name.rsplit(".np")[0]
        names = [name, short] + [f"{short}.long"] * LONG
        table = pathlib.Path(__file__).resolve().parent / folder / "warns.txt"
        lines = [line.split() for line in table.read_text().splitlines() if line and not line.startswith("#")] if table.is_file() else []
        self.codes = {code.rstrip(":") for code, *patterns in lines if any(fnmatch.filter(names, pattern) for pattern in patterns)}

    def judge(self, codes, accepted):
        """Of one run, which may have those that its options accept."""
        require(codes - accepted <= self.codes, f"warnings {sorted(codes)}; warns.txt lists {sorted(self.codes)}")
        self.seen |= codes & self.codes

    def judge_end(self):
        """Of the test."""
        require(self.seen == self.codes, f"no run has the warnings {sorted(self.codes - self.seen)} that warns.txt lists")


EXPECTED = Expected()


def require(condition, sentence):
    """Fails the test with the sentence unless the condition holds."""
    if not condition:
        raise Failure(sentence)


def waiting():
    """The environment of ranks that wait for one another: they sleep, see idle/idle.c. What a test loads itself comes first."""
    libraries = [os.environ.get(name) for name in ("LD_PRELOAD", "MORTISE_TEST_IDLE")]
    return {"LD_PRELOAD": ":".join(filter(None, libraries))}


class Run:
    """One run of the program: what it said, and its files, read when asked for."""

    def __init__(self, program, mpiexec, ranks, folder, arguments, idle=False):
        self.program, self.mpiexec, self.ranks, self.arguments = program, mpiexec, ranks, list(arguments)
        self.folder = pathlib.Path(folder)
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        launcher = [mpiexec, "-n", str(ranks)] if ranks > 1 else []
        self.command = launcher + [program] + CHECKS + ["-output", NAME] + self.arguments
        if idle:
            return
        environment = os.environ | (waiting() if ranks > 1 else ALONE)
        done = subprocess.run(self.command, cwd=self.folder, env=environment, capture_output=True, text=True, timeout=TIMEOUT, errors="replace")
        self.exit, self.stdout, self.stderr = done.returncode, done.stdout, done.stderr

    def again(self, *arguments, ranks=None, name="again", warns=None):
        """The same scene once more, with more arguments or on another number of ranks, solved, with warnings as require_solved() has them."""
        other = Run(self.program, self.mpiexec, ranks or self.ranks, self.folder / name, self.arguments + list(arguments))
        try:
            other.require_solved(warns)
        except Failure as failure:
            raise Failure(f"{failure}, when run again {other.describe()}") from None
        return other

    def require_solved(self, warns=None):
        """Solved, with warnings of the codes `warns`, or, without these, of none but those of the test's table; and nothing else to say."""
        require(self.exit == 0, f"exit code {self.exit} instead of 0")
        self.require_warned(warns)
        self.require_clean()

    def require_warned(self, warns=None):
        """Warnings of these codes in the summary, and the same lines on stderr, with nothing beside them."""
        steps = [w for step in self.summary.get("steps", []) for w in step["warnings"]]
        accepted = {w["code"] for w in self.summary["warnings"] + steps if w.get("accepted")}
        warnings = [w for w in self.summary["warnings"] if not w.get("accepted")]  # the others have no line
        told = [WARNING.fullmatch(line) for line in self.stderr.splitlines()]
        require(all(told), "stderr has lines that are no warnings")
        codes = {w["code"] for w in self.summary["warnings"] + steps} | {line["code"] for line in told}
        if warns is None:
            EXPECTED.judge(codes, accepted)
        else:
            require(codes == set(warns), f"warnings {sorted(codes)} instead of {sorted(warns)}")
            EXPECTED.seen |= codes & EXPECTED.codes
        if "-quiet" in self.arguments:
            require(not told, "-quiet prints warnings")
        elif any(line["label"] for line in told):  # of several runs, the first that warns of something prints it
            require({w["code"] for w in warnings} <= {line["code"] for line in told}, "stderr does not have all warnings of the summary")
        else:
            same("lines of stderr", sorted(line["words"] for line in told), sorted("; ".join(filter(None, (w["text"], w["advice"]))) for w in warnings))

    def require_clean(self):
        leak = LEAK.search(self.stdout + self.stderr)
        require(not leak, f"memory was not freed: {leak and leak.group()}")
        require("runtime error:" not in self.stderr and "AddressSanitizer" not in self.stderr, "a sanitizer complains")

    def some(self, variants):
        """All of the variants on one rank, and in the long run; on several ranks, where each start takes long, the first and the last: what
        the ranks do is the same in all of them."""
        variants = list(variants)
        return variants if self.ranks == 1 or LONG else variants[:1] + variants[-1:]

    @property
    def summary(self):
        """The JSON summary."""
        return json.loads((self.folder / f"{NAME}.json").read_text(), parse_constant=lambda word: require(False, f"the summary has {word}"))

    def pair(self, name):
        return self.summary["pairs"][name]

    def probe(self, name):
        return self.summary["probes"][name]

    def table(self, pair):
        """The CSV table of a pair: a list of numbers (or words) for each column's name."""
        return read_table(self.folder / f"{NAME}_{pair}.csv")

    def fields(self):
        """The HDF5 file, open for reading."""
        import h5py  # pylint: disable=import-outside-toplevel

        return h5py.File(self.folder / f"{NAME}.h5", "r")

    def describe(self):
        said = f"\n--- stdout\n{self.stdout}\n--- stderr\n{self.stderr}" if hasattr(self, "exit") else ", not run"
        return f"in {self.folder}:\n{' '.join(self.command)}{said}"


# --- comparisons ------------------------------------------------------------------------------------------------------


def near(what, value, expected, relative=0.0, absolute=0.0):
    """|value - expected| <= absolute + relative |expected|, for numbers or lists of them (relative to the largest)."""
    values, targets = as_list(value), as_list(expected)
    require(len(values) == len(targets), f"{what}: {len(values)} numbers instead of {len(targets)}")
    scale = max((abs(t) for t in targets), default=0.0)
    for place, (v, t) in enumerate(zip(values, targets)):
        off = abs(v - t) if isinstance(v, (int, float)) else math.inf
        require(off <= absolute + relative * scale, f"{what}[{place}] = {v!r}, expected {t!r}: off by {off:.3g}, allowed {absolute + relative * scale:.3g}")


def as_list(value):
    return list(value) if isinstance(value, (list, tuple)) or hasattr(value, "__array__") and getattr(value, "ndim", 0) else [value]


def same(what, value, expected):
    """Equality of things that are counted or named."""
    require(value == expected, f"{what} = {value!r}, expected {expected!r}")


def read_table(path):
    """A CSV file as {column: [values]}; lines that begin with # are comments."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    columns = {}
    for place, name in enumerate(rows[0]):
        columns[name.strip()] = [number_or_word(row[place]) for row in rows[1:]]
    return columns


def number_or_word(text):
    try:
        return float(text)
    except ValueError:
        return text.strip()


def same_table(table, expected, tolerances, position=("x", "y", "z"), distance=1e-9):
    """Compares the columns named in tolerances = {column: (relative, absolute)} at points matched by position.

    Points are the same if they are nearer than distance (relative to the extent of all); relative tolerances are relative
    to the largest value of the expected column. Columns of words are compared as they stand. The worst point is told.
    """
    axes = [axis for axis in position if axis in expected]
    points, targets = list(zip(*(table[a] for a in axes))), list(zip(*(expected[a] for a in axes)))
    require(len(points) == len(targets), f"{len(points)} points instead of {len(targets)}")
    partner = match_points(points, targets, distance)
    for column, (relative, absolute) in tolerances.items():
        if any(isinstance(e, str) for e in expected[column]):
            wrong = [t for t, p in enumerate(partner) if table[column][p] != expected[column][t]]
            require(not wrong, f"{column} differs at {len(wrong)} points, first at {wrong and targets[wrong[0]]}")
            continue
        scale = max((abs(e) for e in expected[column] if math.isfinite(e)), default=0.0)
        pairs = [(table[column][p], expected[column][t]) for t, p in enumerate(partner)]
        offs = [0 if math.isnan(a) and math.isnan(b) else abs(a - b) for a, b in pairs]  # both have no number there
        worst = max(range(len(offs)), key=lambda t: offs[t] if offs[t] == offs[t] else math.inf)
        allowed = absolute + relative * scale
        require(offs[worst] <= allowed, f"{column} = {table[column][partner[worst]]!r} at {targets[worst]}, expected "
                                        f"{expected[column][worst]!r}: off by {offs[worst]:.3g}, allowed {allowed:.3g}")


def match_points(points, targets, distance):
    """For each target the place of its point; several points in one place are taken in their order."""
    extent = max((max(axis) - min(axis) for axis in zip(*targets)), default=0.0)
    width = 2 * distance * extent or 1.0  # of a grid: what is near lies in the same cell or beside it
    cell = lambda point: tuple(math.floor(x / width) for x in point)
    free, partner = {}, []
    for p, point in enumerate(points):
        free.setdefault(cell(point), []).append(p)
    for target in targets:
        around = itertools.product(*((k - 1, k, k + 1) for k in cell(target)))
        near_by = [p for place in around for p in free.get(place, ())]
        nearest = min(near_by, key=lambda p: (math.dist(points[p], target), p), default=None)
        require(nearest is not None and math.dist(points[nearest], target) <= distance * extent, f"there is no point at {target}")
        free[cell(points[nearest])].remove(nearest)
        partner.append(nearest)
    return partner


# --- verdicts ---------------------------------------------------------------------------------------------------------


def judge_mistake(run, texts):
    """A user's mistake: exit code 1, one sentence that names the culprit, no file."""
    told = [line for line in run.stderr.splitlines() if line.startswith("mortise: ")]
    same("exit code", run.exit, 1)
    require(len(told) == 1, f"{len(told)} sentences instead of one")
    require("PETSC ERROR" not in run.stdout + run.stderr, "PETSc's trace is shown")
    run.require_clean()
    for text in texts:
        require(text in told[0], f"the sentence does not say '{text}'")
    left = sorted(str(path.relative_to(run.folder)) for path in run.folder.rglob("*"))
    require(not left, f"files are left behind: {', '.join(left)}")


def load(path):
    """The judge() of a check file."""
    sys.path.insert(0, str(path.parent))
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.judge


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--scratch", required=True, help="folder of the run, emptied before")
    parser.add_argument("--check", type=pathlib.Path, help="file with judge(run)")
    parser.add_argument("--says", action="append", help="the run is a mistake whose sentence has this text; may be repeated")
    parser.add_argument("--own-runs", action="store_true", help="the check makes all runs itself, by again() or Run()")
    parser.add_argument("--any-end", action="store_true", help="the check judges the exit code, too")
    parser.add_argument("arguments", nargs=argparse.REMAINDER, help="after --: arguments of the program")
    options = parser.parse_args()
    arguments = options.arguments[1:] if options.arguments[:1] == ["--"] else options.arguments

    sys.modules["judge"] = sys.modules["__main__"]  # so that a check's `from judge import near` meets this very module
    run = None
    EXPECTED.read(pathlib.Path(options.scratch).name)
    try:
        run = Run(options.program, options.mpiexec, options.ranks, options.scratch, arguments, options.own_runs)
        if options.says:
            judge_mistake(run, options.says)
        else:
            if not options.any_end and not options.own_runs:
                run.require_solved()
            if options.check:
                load(options.check)(run)
            EXPECTED.judge_end()
    except (Failure, subprocess.TimeoutExpired) as failure:
        sys.exit(f"{failure}\n{run.describe() if run else ''}")


if __name__ == "__main__":
    main()
