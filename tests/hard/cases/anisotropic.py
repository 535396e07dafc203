"""Compliance across the pressure, of axes turned by an angle: c^4 / E2 + s^4 / E1 + c^2 s^2 (1 / G - 2 nu / E1)."""
from math import cos, radians, sin

from judge import near


def compliance(angle):
    c, s = cos(radians(angle)) ** 2, sin(radians(angle)) ** 2
    return c * c / 1e2 + s * s / 1e5 + c * s * (1 / 50 - 2 * 0.3 / 1e5)


def judge(run):
    for solved in (run, run.again("-order", "2", name="quadratic")):
        for name in ("joint", "floor"):
            table = solved.table(name)
            near(f"pressure of {name}", table["pressure"], [1] * len(table["pressure"]), absolute=1e-9)
        near("potential", solved.summary["energy"]["potential"], -0.5 * (compliance(30) + compliance(-50)), relative=1e-10)
