"""The GRECO block, against limits of fine meshes that an independent program has found, on 128 edges."""
from judge import near, require

SLIP = {0: 2.8603, 1.25: 2.7226, 5: 2.2868, 7.5: 1.98076, 11.25: 1.54140}  # u_x in 1e-5 m at x in mm


def judge(run):
    table = run.table("floor")
    for x, slip in SLIP.items():
        row = min(range(len(table["x"])), key=lambda r: abs(table["x"][r] - 1e-3 * x))
        near(f"slip at x = {x} mm", 1e5 * table["slip_x"][row], slip, relative=3e-4)
    edge = 0.04 / 128
    slipping = [x for x, status in zip(table["x"], table["status"]) if status == 3]
    near("where it slips", [1e3 * min(slipping), 1e3 * max(slipping)], [3.2, 29.8], absolute=1e3 * 1.5 * edge)
    friction = run.summary["solver"]["friction"]
    near("rho", friction["rho"], 0.37, absolute=0.01)
    require(friction["unique"] and run.summary["solver"]["iterations"] <= 14, f"{run.summary['solver']['iterations']} steps")
    require(run.summary["solver"]["cross_check"]["agree"], "the second solution differs")
