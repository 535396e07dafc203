"""The run once more with memory that is full of NaN where nobody has written (fresh.c): the same end, the same words, the same numbers. On one
rank they are the same to the last bit; on several, libraries add what other ranks send in the order in which it arrives, so that no two runs
are alike beyond rounding."""
import os

from judge import Run, near, require, same, same_table

TIMES = ("timing", "memory", "contact_ratio", "options")  # of the summary: those of each run, and the names of its files
ROUNDING = 1e-9  # of forces and energies, relative to the largest, between two runs on several ranks


def with_fresh_memory(run):
    os.environ["LD_PRELOAD"] = os.environ["MORTISE_FRESH"]
    try:
        return Run(run.program, run.mpiexec, run.ranks, run.folder / "fresh", run.arguments)
    finally:
        del os.environ["LD_PRELOAD"]


def leaves(tree, path=""):
    """(path, value) of everything in a summary but times."""
    if not isinstance(tree, (dict, list)):
        yield path, tree
        return
    for key, value in tree.items() if isinstance(tree, dict) else enumerate(tree):
        if key not in TIMES and not str(key).startswith(("seconds_", "peak_bytes")):
            yield from leaves(value, f"{path}.{key}")


def require_equal(run, other):
    numbers, expected = dict(leaves(other.summary)), dict(leaves(run.summary))
    differ = [f"{path}: {numbers.get(path)!r} instead of {value!r}" for path, value in expected.items() if numbers.get(path) != value]
    require(not differ and len(numbers) == len(expected), f"memory that nobody has written counts: {'; '.join(differ[:9])}")
    for pair in run.summary["pairs"]:
        name = f"result_{pair}.csv"
        if (run.folder / name).exists():
            require((run.folder / name).read_bytes() == (other.folder / name).read_bytes(), f"{name} differs")


def require_near(run, other):
    near("potential", other.summary["energy"]["potential"], run.summary["energy"]["potential"], relative=ROUNDING)
    for key in ("active", "changed"):
        same(key, other.summary["solver"][key], run.summary["solver"][key])
    for pair in run.summary["pairs"]:
        same_table(other.table(pair), run.table(pair), {"pressure": (ROUNDING, 0), "status": (0, 0)})


def judge(run):
    other = with_fresh_memory(run)
    same("exit code", other.exit, run.exit)
    same("stderr", other.stderr, run.stderr)
    if (run.folder / "result.json").exists():
        (require_equal if run.ranks == 1 else require_near)(run, other)
