"""A second run with fresh memory full of NaN (fresh.c): the same exit code, words and numbers, up to rounding. Sums of libraries depend on the
order of messages and on the alignment of memory."""
import os

from judge import LONG, Run, near, require, same, same_table

TIMES = ("timing", "memory", "contact_ratio", "options")  # of the summary: those of each run, and the names of its files
# Between two runs, relative to the largest: measured are 3.1e-13 and 1.5e-15 with the kernels of SkylakeX; long tests ask hard cases, too.
PRESSURE, POTENTIAL = (1e-9, 1e-9) if LONG else (1e-11, 1e-13)


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


def both_real(a, b):
    """Two numbers that are not both counts: 0 may be 2e-17 another time."""
    return all(isinstance(x, (int, float)) and not isinstance(x, bool) for x in (a, b)) and (isinstance(a, float) or isinstance(b, float))


def require_near(run, other):
    """A number stays a number and a word the same word; what the scene asks for is the same."""
    values, expected = dict(leaves(other.summary)), dict(leaves(run.summary))
    differ = [f"{path}: {values.get(path)!r} instead of {value!r}" for path, value in expected.items()
              if path not in values or (values[path] != value and not both_real(values[path], value))]
    require(not differ and len(values) == len(expected), f"memory that nobody has written counts: {'; '.join(differ[:9])}")
    potential = run.summary["energy"]["potential"]
    if potential is not None:
        near("potential", other.summary["energy"]["potential"], potential, relative=POTENTIAL)
    for pair in run.summary["pairs"]:
        if (run.folder / f"result_{pair}.csv").exists():
            same_table(other.table(pair), run.table(pair), {"pressure": (PRESSURE, 0), "status": (0, 0)})


def judge(run):
    other = with_fresh_memory(run)
    same("exit code", other.exit, run.exit)
    same("stderr", other.stderr, run.stderr)
    if (run.folder / "result.json").exists():
        require_near(run, other)
