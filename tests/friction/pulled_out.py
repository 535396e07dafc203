"""Bodies that interference or tension presses, by what friction can hold at most: Lame's pressure, that of a block, Eytelwein's tensions. Statics refuse no such load, and above the limit the
program ended with exit code 3. There the bodies slide on and on, under the same forces everywhere; that motion is told."""
from judge import Run, near, require, same

# Motion; limit of the work on it; work of another load on it; the next load, in parts of the limit. Belts have a thickness, and cells.
SHAFT, BLOCK, BELT = 44532.0758, 20, 1000 * 1.01
CASES = {"fit": ("body shaft slides along (0, 1)", SHAFT, 0, 1.002), "jaw": ("body block slides along (0.8, 0.6, 0)", BLOCK, 0, 1.002),
         "bar": ("body belt turns about (0, 0), turning clockwise", BELT, -0.410209 * BELT, 1.02)}


def judge(run):
    motion, limit, other, part = CASES[list(run.summary["pairs"])[0]]
    same("held", [step["status"] for step in run.summary["steps"]], ["solved"] * len(run.summary["steps"]))
    for solver in ("cholesky", "truncatedmg"):
        done = Run(run.program, run.mpiexec, run.ranks, run.folder / solver, [*run.arguments, "-load_steps", f"0.5,{part}", "-pc_type", solver])
        same(f"{solver}: exit code", done.exit, 2)
        same(f"{solver}: steps", [step["status"] for step in done.summary["steps"]], ["solved", "no_solution"])
        require(motion in done.stderr and "friction is too small" in done.stderr, done.stderr)
        near(f"{solver}: work of the loads", done.summary["solvability"]["work"], part * limit + other, relative=1e-4)
