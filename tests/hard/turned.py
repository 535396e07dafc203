"""The same scene turned in space: the contact has the same numbers, and so has the validity report."""
import math

from judge import near

MAPS = {"lower": ("x", "y", "z*(0.6-0.02*(x^2+y^2))"), "upper": ("x", "y", "(0.6+0.02*x^2)*(1-z)+(1.3-0.3*(x^2+y^2))*z")}


def rotation(axis, angle):
    """Rows of a rotation about an axis of length 1."""
    x, y, z = axis
    c, s = math.cos(angle), math.sin(angle)
    return [[c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s],
            [y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s],
            [z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)]]


def judge(run):
    turn = rotation([number / math.sqrt(14) for number in (1, 2, 3)], 0.7)
    arguments = ["-upper_bc_displacement_top", ",".join(repr(0.0004 * row[0] - 0.003 * row[2]) for row in turn)]
    for body, place in MAPS.items():
        arguments += [f"-{body}_map", ", ".join("+".join(f"({row[k]!r})*({place[k]})" for k in range(3)) for row in turn)]
    other = run.again(*arguments, name="turned")
    for key in ("normal_force", "area", "max_pressure"):
        near(key, other.pair("joint")[key], run.pair("joint")[key], relative=1e-8)
    for name, indicator in run.summary["validity"]["indicators"].items():
        near(name, other.summary["validity"]["indicators"][name]["value"], indicator["value"], relative=1e-5)
