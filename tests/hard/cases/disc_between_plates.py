"""Forces, and the plane of symmetry."""
from judge import near


def judge(run):
    for name, sign in (("below", 1), ("above", -1)):
        near(f"force {name}", run.pair(name)["force"], [0, 10 * sign], absolute=1e-9)
        table = run.table(name)
        rows = sorted(zip(table["x"], table["pressure"]))
        near(f"pressure {name}, mirrored", [p for _, p in reversed(rows)], [p for _, p in rows], relative=1e-8)
