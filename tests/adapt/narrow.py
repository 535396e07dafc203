"""A rigid parabola narrower than a cell, between its nodes and quadrature points: one mesh says that it is missed, -adapt finds it."""
from judge import Run, near, require, same

FORCE = 0.89113  # 262 000 unknowns of order 2 on uniform quadrilaterals: 32768 cells, 4 in the half width


def judge(run):
    estimate, warning = run.summary["estimate"], run.summary["warnings"][0]
    near("error of a mesh without contact", estimate["energy_norm_relative"], 1, absolute=1e-12)
    same("warning", warning["code"], "hidden_contact")
    near("its place", warning["at"][0], 0.25, absolute=1e-4)
    require("0.0025" in warning["text"], warning["text"])
    for order in (1, 2):
        found = Run(run.program, run.mpiexec, run.ranks, run.folder / f"order_{order}", run.arguments + ["-order", f"{order}", "-adapt", "0.05"])
        pair, bars = found.pair("joint"), found.summary["bars"]["pairs"]["joint"]
        near(f"force, order {order}", pair["normal_force"], FORCE, absolute=bars["normal_force"])
        require(bars["normal_force"] < 0.03 * FORCE, f"order {order}: the bar {bars['normal_force']} says nothing")
