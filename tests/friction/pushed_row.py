"""Two blocks pushed along a floor, by less than friction holds, and by more: no finite slip is an equilibrium then. The proximal point iteration went on for 46 steps, 7 now. Its
state was told as one with tension. It is not refused: forces within the cones balance up to a push of 1.03, since the joint between the blocks, which does not slip, may carry weight."""
from judge import Run, near, require, same


def judge(run):
    pairs = run.summary["pairs"]
    near("friction", sum(pairs[name]["tangential_force"][0] for name in ("rough", "smooth")), -0.95, relative=1e-7)
    near("weight", sum(pairs[name]["normal_force"] for name in ("rough", "smooth")), 1.9392, relative=1e-7)
    for solver in ("cholesky", "truncatedmg"):
        slid = Run(run.program, run.mpiexec, run.ranks, run.folder / solver, [*run.arguments, "-left_bc_traction_left", "1.007,0", "-pc_type", solver])
        same(f"exit code by {solver}", slid.exit, 3)
        require("the bodies slide on and on" in slid.stderr, slid.stderr)
        sweeps = slid.summary["solver"]["sweeps"]
        require(sweeps <= 10, f"{solver}: {sweeps} proximal point steps")
