"""Scenes whose answers are known from other scenes."""
import math

from judge import Run, near, require, same, same_table


def constrained(table):
    """The rows of nodes with a multiplier."""
    rows = [place for place, status in enumerate(table["status"]) if status >= 0]
    return {column: [values[place] for place in rows] for column, values in table.items()}


def judge_twin(run, twin, relative=1e-10):
    """The same multipliers, gaps and energy; where only one of the two has a node or a multiplier, nothing presses."""
    mine, other = constrained(run.table("joint")), constrained(twin.table("joint"))
    require(mine["x"] and len(mine["x"]) == len(other["x"]), f"{len(mine['x'])} multipliers instead of {len(other['x'])}")
    size = max(map(abs, other["gap"]))
    same_table(mine, other, {"pressure": (relative, 0), "gap": (0, relative * size), "status": (0, 0)})
    near("energy", run.summary["energy"]["potential"], twin.summary["energy"]["potential"], relative=relative)
    require(math.isfinite(size), "a gap is not a number")


def judge_apart(run):
    """The pair carries nothing, and both bodies hang and stand as each would alone: energies of the bodies in scenes of their own."""
    near("force", run.pair("joint")["normal_force"], 0, absolute=1e-13)
    same("nodes in contact", run.pair("joint")["active_nodes"], 0)
    for body in ("upper", "lower"):
        alone = Run(run.program, run.mpiexec, run.ranks, run.folder / body, run.arguments + ["-bodies", body, "-pairs", "wall", "-wall_nonmortar", f"{body}:left",
                    "-wall_obstacle", "plane", "-wall_obstacle_point", "-9,0", "-wall_obstacle_normal", "1,0", "-wall_allow_empty", "-cross_check", "0", "-options_allow_unused"])
        same(f"exit code of {body} alone", alone.exit, 0)
        near(f"energy of {body}", run.summary["energy"]["strain"][body], alone.summary["energy"]["strain"][body], relative=1e-11, absolute=1e-30)


def judge_slab(run, plane, layers):
    """A slab between two planes of symmetry against the plane scene with the same cells: forces, energy, nodes in contact of all layers of nodes."""
    options = {name: text for name, text in run.summary["options"].items() if not text.startswith("front,back") and name != "output"} | plane
    twin = Run(run.program, run.mpiexec, run.ranks, run.folder / "plane", [word for name, text in options.items() for word in ("-" + name, text) if word])
    twin.require_solved()
    near("force", [f for k, f in enumerate(run.pair("joint")["force"]) if k != 1], twin.pair("joint")["force"], relative=1e-8)
    near("potential", run.summary["energy"]["potential"], twin.summary["energy"]["potential"], relative=1e-8)
    same("nodes", run.pair("joint")["active_nodes"], layers * twin.pair("joint")["active_nodes"])
