"""A shaft pulled out of its hub, against Lame's formulas and reciprocity with them; the dissipation of sliding against force times way."""
import math

from judge import near, require, same

YOUNG, B, R, LENGTH, INTERFERENCE, MU = 210e3, 20, 40, 30, 0.02, 0.15
AREA = 2 * math.pi * B * LENGTH
LAME = INTERFERENCE * YOUNG * (1 - B**2 / R**2) / (2 * B)


def compliance(poisson):
    """Interference that a unit pressure takes; Poisson's ratio is that of the shaft, and 0 in the hub."""
    return B / YOUNG * (1 - poisson + (R**2 + B**2) / (R**2 - B**2))


def reciprocal(run, poisson):
    """The sum of pressures that belongs to the tangential tractions found: a pulled shaft becomes thinner."""
    table = run.table("fit")
    shear = [f * q / p for f, q, p in zip(table["force"], table["tangential_traction_y"], table["pressure"])]  # forces of nodes
    force, moment = sum(shear), sum(q * y for q, y in zip(shear, table["y"]))
    near("tangential force", run.pair("fit")["tangential_force"][1], force, relative=1e-9)
    return (INTERFERENCE * AREA - 2 * poisson / YOUNG * (force * LENGTH - moment)) / compliance(poisson)


def judge(run):
    steps = run.summary["steps"]
    pressed = steps[0]["energy"]["balance"]
    near("work of the interference", pressed["work"], INTERFERENCE * steps[0]["pairs"]["fit"]["normal_force"] / 2, relative=1e-9)
    for before, step in zip(steps, steps[1:]):
        pulled = (before["reactions"]["shaft:top"][1] + step["reactions"]["shaft:top"][1]) / 2 * 0.002 * (step["t"] - before["t"])
        near("work of the pull", step["energy"]["balance"]["work"], pulled, relative=1e-8)
    shares = [step["pairs"]["fit"]["slip_share"] for step in steps]
    require(all(share < 1 for share in shares[:4]), f"slips too early: {shares}")
    near("it slides in the end", shares[5:], [1, 1], relative=1e-12)
    sliding = steps[-1]["pairs"]["fit"]
    near("friction", sliding["tangential_force"][1], MU * sliding["normal_force"], relative=1e-9)
    near("dissipation", sliding["dissipation"], sliding["tangential_force"][1] * 0.004, relative=1e-8)
    thin = run.again("-hub_poisson", "0", name="thin")
    near("pressures", thin.pair("fit")["normal_force"], reciprocal(thin, 0.3), relative=1e-5)
    plain = run.again("-hub_poisson", "0", "-shaft_poisson", "0", name="plain")
    for step in plain.summary["steps"]:
        near(f"pressures at t = {step['t']}", step["pairs"]["fit"]["normal_force"], LAME * AREA, relative=1e-5)
    near("force of the sliding shaft", plain.pair("fit")["tangential_force"][1], MU * LAME * AREA, relative=1e-5)
    same("one solution", plain.summary["solver"]["friction"]["unique"], True)
