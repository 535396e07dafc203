"""The lining of a clutch: its torque where a part slides and where all of it does, against the formulas of thin linings; work against torque times twist."""
import math

from judge import near

INNER, OUTER, HEIGHT, SHEAR, LIMIT, TWIST = 60, 100, 4, 100, 0.2, 1e-4


def torque(twist):
    stuck = min(max(LIMIT * HEIGHT / (SHEAR * twist), INNER), OUTER)
    return 2 * math.pi * (SHEAR * twist * (stuck**4 - INNER**4) / (4 * HEIGHT) + LIMIT * (OUTER**3 - stuck**3) / 3)


def judge(run):
    steps = run.summary["steps"]
    for step in steps:
        near(f"force at t = {step['t']}", step["pairs"]["disc"]["normal_force"], 0.5 * math.pi * (OUTER**2 - INNER**2), relative=1e-5)
    for step, share, error in ((1, 1 - (80**2 - INNER**2) / (OUTER**2 - INNER**2), 2e-3), (2, 1, 1e-4)):
        near(f"share that slips at t = {step}", steps[step]["pairs"]["disc"]["slip_share"], share, absolute=0.04)
        near(f"torque at t = {step}", -steps[step]["pairs"]["disc"]["patches"][0]["moment"][2], torque(step * TWIST), relative=error)
    finer = run.again("-load_steps", "0,1,2,3", name="on")  # it slides on: no more strain, all work is friction's
    last = finer.summary["steps"][-1]
    near("work of the third step", last["pairs"]["disc"]["dissipation"], torque(1) * TWIST, relative=1e-3)
    near("defect", last["energy"]["balance"]["defect"], 0, absolute=1e-3 * torque(1) * TWIST)
