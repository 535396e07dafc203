"""Timoshenko, Analysis of bi-metal thermostats (1925): far from its ends a strip of two metals bends by the curvature
6 (a1 - a2) T (1 + m)^2 / (h (3 (1 + m)^2 + (1 + m n) (m^2 + 1 / (m n)))), m = h1 / h2, n = E1 / E2. The lower layer, which grows more, is
outside, so the strip bends up. Quadratic cells have the solution exactly there; what the ends disturb falls by exp(-4) for each height at least.
Half the temperature bends it half as much: in a load step, and with a temperature of the region alone beside that of the body."""
from judge import near


def curvature(probes):
    below, middle, above = (probes[name]["displacement"][1] for name in "abc")
    return (below - 2 * middle + above) / 16


def judge(run):
    m, n, h, difference = 0.3 / 0.7, 0.5, 1.0, 1e-5 * 100
    expected = 6 * difference * (1 + m)**2 / (h * (3 * (1 + m)**2 + (1 + m * n) * (m**2 + 1 / (m * n))))
    near("curvature", curvature(run.summary["probes"]), expected, relative=1e-6)
    steps = run.again("-load_steps", "0.5,1", name="steps").summary["steps"]
    near("curvatures of load steps", [curvature(step["probes"]) for step in steps], [expected / 2, expected], relative=1e-6)
    # the region is 75 warmer and the body 100: 2e-5 * 75 - 1e-5 * 100 is half the difference
    other = run.again("-strip_soft_temperature", "75", name="cooler")
    near("curvature with a temperature of the region", curvature(other.summary["probes"]), expected / 2, relative=1e-6)
