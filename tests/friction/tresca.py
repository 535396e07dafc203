"""Tresca's limit: the block is pushed along with less than the limit holds, and stops; it is found not to be held where the limit is lower."""
from judge import Run, near, require


def judge(run):
    pair, table = run.pair("floor"), run.table("floor")
    near("tangential force", pair["tangential_force"], [-4e3, 0], relative=1e-11)
    require(max(abs(q) for q in table["tangential_traction_x"]) <= 2500 * (1 + 1e-11), "a traction is beyond the limit")
    require(run.summary["solver"]["friction"]["rho"] == 0, "limits that do not depend on the pressure have rho = 0")
    require(run.again("-cross_check", name="checked").summary["solver"]["cross_check"]["agree"], "the second solution differs")
    for bound, ends in ((2002, 0), (1998, 2)):  # 4000 of 2 of length
        done = Run(run.program, run.mpiexec, run.ranks, run.folder / f"bound{bound}", [*run.arguments, "-floor_friction_bound", str(bound)])
        require(done.exit == ends, f"bound {bound}: exit {done.exit}, {done.stderr}")
        require(ends == 0 or "slides along (1, 0): the loads do +4000 of work" in done.stderr, done.stderr)
