"""Uniform stress through nearly incompressible bodies (nu = 0.4999), whatever the cells: pressures, and all of the stress tensor."""
import pathlib

from judge import near, require

POISSON = 0.4999
# Relative. A pressure k theta is a strain times a bulk modulus that is 5000 times the shear modulus: so much rounding of it shows.
TOLERANCE = 1e-9
SWEEPS = 5  # of the springs; 3 are needed at nu = 0.3, and up to 12 were where the bulk modulus was taken for the stiffness
UNIAXIAL = (0, -1e6, -POISSON * 1e6)  # sigma_xx, sigma_yy, sigma_zz in plane strain
STRESS = {"narrow": UNIAXIAL, "wide": UNIAXIAL, "solid": (0, 0, -1e6), "cylinders": (0, -3, 0)}


def judge(run):
    stress = STRESS[pathlib.Path(run.arguments[run.arguments.index("-options_file") + 1]).stem]
    pressure = -min(stress)
    for pair in run.summary["pairs"]:
        table = run.table(pair)
        pressed = [p for p, status in zip(table["pressure"], table["status"]) if status == 1]
        require(pressed, f"{pair}: nothing touches")
        near(f"pressure of {pair}", pressed, [pressure] * len(pressed), relative=TOLERANCE)
    require(run.summary["solver"]["sweeps"] <= SWEEPS, f"springs take {run.summary['solver']['sweeps']} sweeps")
    with run.fields() as file:
        found = file["stress"][()]  # 3 x 3, row by row
    for place in range(9):
        expected = stress[place // 3] if place % 4 == 0 else 0.0
        near(f"sigma_{'xyz'[place // 3]}{'xyz'[place % 3]}", found[:, place], [expected] * len(found), absolute=TOLERANCE * pressure)
    if stress is STRESS["cylinders"]:  # the scene has the exact displacement
        for name in ("l2_relative", "energy_relative"):
            near(name, run.summary["errors_total"][name], 0, absolute=TOLERANCE)
