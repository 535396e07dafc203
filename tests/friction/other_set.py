"""A load that friction holds, where a state that slides on and on has both nodes with friction open, and friction changes pressures little while all nodes are closed: no refusal. Statics of the
equilibrium: friction balances the tractions, within the cones of both nodes."""
from judge import Run, near, require

LOAD = 0.18 * (-0.315 / 2 + 1.407 - 0.706 - 0.162 / 2)  # to the right
COEFFICIENTS = {0.18: 0.535, 0.36: 4.69}


def judge(run):
    for solver in ("cholesky", "truncatedmg"):
        done = Run(run.program, run.mpiexec, run.ranks, run.folder / solver, [*run.arguments, "-pc_type", solver])
        require(done.exit == 0, f"{solver}: exit {done.exit}: {done.stderr}")
        near(f"{solver}: friction", done.pair("floor")["tangential_force"][0], -LOAD, relative=1e-7)
        table = done.table("floor")
        for x, pressure, friction in zip(table["x"], table["pressure"], table["tangential_traction_x"]):
            limit = next((mu for place, mu in COEFFICIENTS.items() if abs(x - place) < 0.05), 0)
            require(abs(friction) <= limit * pressure * (1 + 1e-9) + 1e-10, f"{solver}: friction {friction} of {limit} times {pressure} at {x}")
