"""A block twisted by the moment 100 int r^2 of a traction on its top, and held by friction with a bound e at most. The largest moment is e sum D_a
r_a about the middle. Refused below that bound, solved above it."""
import math

from judge import Run, near, require


def judge(run):
    table = run.table("floor")
    require({3, 4} >= set(table["status"]), f"statuses {set(table['status'])}")
    hold = sum(f / p * math.hypot(x - 1, y - 0.75) for f, p, x, y in zip(table["force"], table["pressure"], table["x"], table["y"]))
    turn = sum(f / p * ((x - 1) * qy - (y - 0.75) * qx) for f, p, x, y, qx, qy in zip(*(table[key] for key in ("force", "pressure", "x", "y", "tangential_traction_x", "tangential_traction_y"))))
    moment = 100 * 2 * 1.5 * (2**2 + 1.5**2) / 12
    near("moment", abs(turn), moment, relative=1e-9)
    least = moment / hold
    for factor, ends in ((0.995, 2), (1.01, 0)):
        done = Run(run.program, run.mpiexec, run.ranks, run.folder / f"bound{factor}", [*run.arguments, "-floor_friction_bound", repr(factor * least)])
        require(done.exit == ends, f"{factor} of the bound {least}: exit {done.exit}, {done.stderr}")
        if ends == 2:
            require("turns about" in done.stderr and "friction is too small" in done.stderr, done.stderr)
