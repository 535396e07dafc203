"""Nodes without a multiplier: tractions are those of the neighbours there, as pressures are, and slips are not known, as gaps are. In the middles of
facets, where vertices alone carry multipliers, of a uniform state; at a held corner, all other nodes of which slip to the same side."""
import pathlib

from judge import Run, near, require

CORNER = pathlib.Path(__file__).resolve().parent.parent / "setup" / "held_corner.opts"
RTOL = 1e-8  # of the solver (-snes_rtol)
DRAWN = ["-joint_gap", "-1e-6", "-joint_friction", "0.01"]


def judge(run):
    table = run.table("joint")
    near("traction", table["tangential_traction_x"], [-0.297] * len(table["x"]), absolute=1e-11)
    judge_slips(table)
    for order in ("1", "2"):
        done = Run(run.program, run.mpiexec, run.ranks, run.folder / f"corner{order}", ["-options_file", str(CORNER), "-order", order, *DRAWN])
        done.require_solved(["model_limit"])
        corner = done.table("joint")
        near("traction", corner["tangential_traction_x"], [0.01 * p for p in corner["pressure"]], relative=RTOL)
        require(min(corner["pressure"]) > 0, f"pressure {corner['pressure']}")
        judge_slips(corner)


def judge_slips(table):
    unknown = [status == -1 for status in table["status"]]
    require(any(unknown) and not all(unknown), f"status {table['status']}")
    for name in ("slip_x", "slip_y"):
        require([value != value for value in table[name]] == unknown, f"{name} {table[name]}")
