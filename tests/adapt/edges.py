"""Which largest pressures have a limit is told by the obstacle's formula, whatever the meshes are. A flat punch has none from the third mesh on. An
edge rounded by 0.03 or 0.003 has one, though its pressures grow like those of the punch while facets are wider than the rounded part."""
from judge import Run, same

FLAT, WEDGE = "abs(x)<0.5 ? -0.01 : 1", "abs(x)/5-0.02"
ROUNDED, SHARP = "max(0,abs(x)-0.4)^2/2/0.03-0.01", "max(0,abs(x-0.13)-0.37)^2/2/0.003-0.01"
# gap, whether cells are kept, numbers of meshes, whether the pressure has no limit
CASES = [(FLAT, False, (3, 5), True), (FLAT, True, (3,), True), (WEDGE, False, (6,), True), (ROUNDED, True, (8, 11), False), (SHARP, False, (10,), False)]


def judge(run):
    for case, (gap, kept, meshes, unbounded) in enumerate(CASES):
        for number in meshes:
            more = ["-joint_obstacle_gap", gap, *(["-adapt_cells", "kept"] if kept else []), "-adapt", "1e-7", "-adapt_max_meshes", str(number)]
            solved = Run(run.program, run.mpiexec, run.ranks, run.folder / f"{case}_{number}", run.arguments + more)
            same("exit", solved.exit, 3)  # by the limit
            bars = solved.summary["bars"]
            same(f"{gap}, kept {kept}, {number} meshes", (bars["unbounded"], bars["pairs"]["joint"]["max_pressure"] is None), (["joint"] if unbounded else [], unbounded))
