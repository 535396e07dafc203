"""Two strips of different expansion: Timoshenko's curvature of thermostats."""
from judge import near

N = 70e3 / 210e3


def judge(run):
    left, middle, right = (run.probe(name)["displacement"][1] for name in ("left", "middle", "right"))
    near("curvature", (left + right - 2 * middle) / 8**2, 24 * (2.3e-5 - 1.2e-5) * 50 / (2 * (14 + N + 1 / N)), relative=1e-7)
    near("upright stress", run.probe("middle")["stress"][1], 0, absolute=1e-7)
