"""Multigrid at full size, the default of large scenes, against the dense system: the same states, forces and tractions, to the tolerance of the iteration.
`patch_solid` took 24 Newton steps where a node whose slip ended in a step did not stick next."""
from judge import near, require, same

PART = 1e-7
MOST = 12  # Newton steps


def judge(run):
    solver = run.summary["solver"]
    require(solver["linear"] == "gmres with truncatedmg", f"{solver['linear']} is no multigrid")
    require(solver["iterations"] <= MOST, f"{solver['iterations']} Newton steps")
    dense = run.again("-pc_type", "cholesky", "-cross_check", "0", name="dense", warns=None)
    for key in ("slipping", "sticking"):
        same(key, solver["friction"][key], dense.summary["solver"]["friction"][key])
    near("rho", solver["friction"]["rho"], dense.summary["solver"]["friction"]["rho"], relative=0.1, absolute=0.02)
    for name, pair in run.summary["pairs"].items():
        other = dense.pair(name)
        force = max(abs(component) for component in other["force"])
        near(f"{name}: force", pair["force"], other["force"], absolute=PART * force)
        if None not in other["tangential_force"]:  # a pair without friction
            near(f"{name}: friction", pair["tangential_force"], other["tangential_force"], absolute=PART * force)
        table, reference = run.table(name), dense.table(name)
        same(f"{name}: status", table["status"], reference["status"])
        for column in [column for column in table if column.startswith(("pressure", "tangential_traction"))]:
            near(f"{name}: {column}", table[column], reference[column], absolute=10 * PART * max(reference["pressure"]))
    if "-ksp_monitor" in run.arguments:
        require("KSP Residual norm" in run.stdout, "-ksp_monitor tells nothing")
