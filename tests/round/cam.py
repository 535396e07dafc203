"""A quarter of a disc that is pressed onto a plane, its upright side guided: the guide feels nothing (the plane's force is upright)."""
from judge import LONG, near
from scenes import Findings, Scene, require

QUARTER = "x*sqrt(1-y^2/2), 1-y*sqrt(1-x^2/2)"  # of [0,1]^2: centre at (0, 1), lowest point at the origin


def judge(run):
    found = Findings()
    for order in (1, 2):
        for cells in (4, 9, 16) if LONG else (7,):
            scene = Scene(order=order)
            scene.block("cam", (cells, cells), (0, 0), (1, 1), young=200, map=QUARTER, bc_normal="left", bc_pressure="bottom", bc_pressure_bottom=0.2)
            scene.plane("floor", "cam", (0, 0), (0, 1), side="right+top")
            with found.case():
                x, y = scene.solve(run, f"cam_{order}_{cells}").pair("floor")["force"]
                near("force", y, 0.2, relative=1e-9)
                require(abs(x) <= 1e-12 * y, f"cam_{order}_{cells}: side force {x:.3g} of the floor beside {y:.3g}")
    found.end()
