"""A uniform pressure of 1e6 passes through every body and every joint, whatever the meshes."""
from judge import near, require

PRESSURE = 1e6


def pressures(run, tolerance):
    """p = 1e6 at every multiplier."""
    for pair in run.summary["pairs"]:
        table = run.table(pair)
        touching = [p for p, status in zip(table["pressure"], table["status"]) if status == 1]
        require(touching, f"{pair}: nothing touches")
        near(f"pressure of {pair}", touching, [PRESSURE] * len(touching), relative=tolerance)


def uniform(run, tolerance=1e-12):
    """Besides, sigma = diag(0, -1e6) at every node."""
    pressures(run, tolerance)
    with run.fields() as file:
        stress = file["stress"][()]  # 3 x 3, row by row
    near("sigma_yy", stress[:, 4], [-PRESSURE] * len(stress), relative=tolerance)
    near("sigma_xx and sigma_xy", list(stress[:, 0]) + list(stress[:, 1]), [0.0] * 2 * len(stress), absolute=tolerance * PRESSURE)


def judge(run):
    uniform(run)
