"""A brick that is turned on a floor: forces at its corners hold most. Beyond that there is certainly no solution. The pyramids around the cones have edges along these forces, and
held 2 % more (exit code 3 at the end of the iteration). Elastic bodies press more evenly and hold less: even pressures hold a slope of 3/8 x 0.3 x 4 x 0.7652, the mean
distance of the points of the square from its middle."""
from judge import Run, near, require, same

LIMIT = 1.5 * 2**0.5 * 0.3
EVEN = 3 / 8 * 0.3 * 4 * 0.76520


def turned(run, slope, name):
    return Run(run.program, run.mpiexec, run.ranks, run.folder / name, [*run.arguments, "-brick_bc_traction_top", f"{slope!r}*(1-y), {slope!r}*(x-1), 0-1"])


def judge(run):
    pair = run.pair("floor")
    near("force", pair["force"], [0, 0, 4], absolute=1e-9)
    require(max(run.summary["solver"]["friction"][key] for key in ("cone", "slip", "dissipation")) < 1e-9, f"{run.summary['solver']['friction']}")
    for part in (1 + 1e-5, 1.01):
        refused = turned(run, part * LIMIT, f"refused{part}")
        same(f"exit code at {part} of the limit", refused.exit, 2)
        require("body brick turns about the axis through (1, 1, 0.25)" in refused.stderr, refused.stderr)
    same("exit code below the limit of even pressures", turned(run, 0.98 * EVEN, "holds").exit, 0)
    for slope in (1.05 * EVEN, 0.999 * LIMIT):  # the middle hardly slips: other pressures might hold it (THEORY, 16.8c)
        turning = turned(run, slope, f"turns{slope:.3f}")
        same(f"exit code between both limits, at {slope}", turning.exit, 3)
        require("the bodies slide on and on" in turning.stderr or "body brick turns about" in turning.stderr, turning.stderr)
