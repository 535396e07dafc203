"""A press fit by temperature: Lame's formulas for thick rings in plane stress, with the interference alpha T b."""
from judge import near, require

B, R_I, R_O = 20.0, 10.0, 40.0
HUB, SHAFT = (210e3, 0.3), (70e3, 0.33)
STRAIN = 1.2e-5 * 120
PRESSURE = STRAIN / (((R_O**2 + B**2) / (R_O**2 - B**2) + HUB[1]) / HUB[0] + ((B**2 + R_I**2) / (B**2 - R_I**2) - SHAFT[1]) / SHAFT[0])
RIM = PRESSURE * 2 * B**2 * R_O / (HUB[0] * (R_O**2 - B**2)) - STRAIN * R_O


def mean_pressure(run):
    return run.pair("fit")["normal_force"] / run.pair("fit")["area"]


def judge(run):
    near("pressure", mean_pressure(run), PRESSURE, relative=1e-3)
    near("rim", run.probe("rim")["displacement"][0], RIM, relative=1e-4)
    finer = run.again("-dm_refine", "1", name="finer")
    require(abs(mean_pressure(finer) - PRESSURE) < abs(mean_pressure(run) - PRESSURE) / 3, "the error does not fall with the mesh")
    # the same interference as a gap, which strains nothing by itself
    given = run.again("-hub_temperature", "0", "-fit_gap", f"{-STRAIN * B}", name="given")
    near("pressure of a gap", mean_pressure(given), mean_pressure(run), relative=1e-4)
