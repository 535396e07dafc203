"""A thin disc that is heated on a rough floor, in both orders: displacements, stress and dissipation of a closed form, those of a disc under a radial body force."""
import math

from judge import near

YOUNG, HEIGHT, RADIUS, PRESSURE, COEFFICIENT, STRAIN = 2e5, 0.02, 3, 10, 0.02, 1e-3
K = COEFFICIENT * PRESSURE / (YOUNG * HEIGHT)
A = STRAIN - 2 * K * RADIUS / 3


def moved(r):
    return A * r + K * r * r / 3


def judge(run):
    for done in (run, run.again("-order", "2", name="quadratic")):
        pair, probes = done.pair("floor"), done.summary["probes"]
        near("displacement", [probes["middle"]["displacement"][0], probes["rim"]["displacement"][0]], [moved(1), moved(RADIUS)], relative=1e-5)
        near("radial stress", probes["middle"]["stress"][0], -COEFFICIENT * PRESSURE / HEIGHT * 2 / 3 * (RADIUS - 1), relative=2e-4)
        near("dissipation", pair["dissipation"], 2 * math.pi * COEFFICIENT * PRESSURE * (A * RADIUS**3 / 3 + K * RADIUS**4 / 12), relative=2e-4)
