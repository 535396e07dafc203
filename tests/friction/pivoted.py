"""A coefficient of 50: among many solutions Newton's steps and sweeps cycle, and complementary pivoting finds one. All of these problems have one, whatever the
coefficient. The program gave up (exit code 3) after 109 steps; with 20 it took 165. With 1e5 pressures are so small beside tangential tractions that the decisions do not
follow from the values of the solution: it gave up after 52 steps before it took those of the basis."""
from judge import Run, require, same

MOST = 12  # Newton steps


def judge(run):
    for coefficient, *more in (("20",), ("50",), ("200",), ("1e5",), ("1e5", "-block_dm_plex_box_faces", "64,64")):
        done = Run(run.program, run.mpiexec, run.ranks, run.folder / f"mu{coefficient}_{len(more)}", [*run.arguments, "-floor_friction", coefficient, *more])
        done.require_solved(["large_friction", "not_unique"])
        solver = done.summary["solver"]
        require(solver["friction"]["rho"] > 1 and not solver["friction"]["unique"], f"{solver['friction']}")
        require(max(solver["friction"][key] for key in ("cone", "slip", "dissipation")) < 1e-9, f"{solver['friction']}")
        require(solver["iterations"] <= MOST, f"coefficient {coefficient}: {solver['iterations']} steps")
    few = Run(run.program, run.mpiexec, run.ranks, run.folder / "few", [*run.arguments, "-snes_max_it", "1"])
    same("exit code after one step", few.exit, 3)
    require("after -snes_max_it iterations" in few.stderr and "-load_steps" not in few.stderr, few.stderr)
