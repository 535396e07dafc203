"""Bodies that interference or tension presses, by what friction can hold at most: Lame's pressure, that of a block, Eytelwein's tensions. Statics refuse no such load. Above the limit the
bodies slide on and on, under the same forces everywhere. That motion is told where friction changes pressures little (eq. 16.8c). In space the load must be larger for that. Tensions of a belt
follow its friction: its load is not solved, and not refused."""
import re

from judge import Run, near, require, same

# Motion; its direction; limit of the work on it; loads in parts of the limit that are not solved, and that are refused.
CASES = {"fit": ("body shaft slides along", (0, 1), 44532.0758, (), (1.002,)), "jaw": ("body block slides along", (0.8, 0.6, 0), 20, (1.002,), (1.06,)), "bar": (None, None, None, (1.02,), ())}


def judge(run):
    motion, direction, limit, open_parts, parts = CASES[list(run.summary["pairs"])[0]]
    same("held", [step["status"] for step in run.summary["steps"]], ["solved"] * len(run.summary["steps"]))
    for solver in ("cholesky", "truncatedmg"):
        for part in (*open_parts, *parts):
            done = Run(run.program, run.mpiexec, run.ranks, run.folder / f"{solver}{part}", [*run.arguments, "-load_steps", f"0.5,{part}", "-pc_type", solver])
            same(f"{solver}: exit code", done.exit, 2 if part in parts else 3)
            same(f"{solver}: steps", [step["status"] for step in done.summary["steps"]], ["solved", "no_solution" if part in parts else "not_converged"])
            told = (motion, "friction is too small") if part in parts else ("friction may not hold these loads",)
            require(all(text in done.stderr for text in told), done.stderr)
            if part in parts:
                near(f"{solver}: direction", [float(x) for x in re.search(r"along \((.*?)\)", done.stderr)[1].split(", ")], direction, absolute=1e-4)
                near(f"{solver}: work of the loads", done.summary["solvability"]["work"], part * limit, relative=1e-4)
