"""A cam on the flat foot of a follower: the spring's force, its lever about the shaft (kinematics) and Hertz' line contact."""
import math

import numpy as np

from judge import near

B, FORCE, WIDTH = math.pi / 4, 4000, 8
MODULUS = 210000 / (2 * (1 - 0.3**2))
LEVER = 5 * math.sin(B) + 2 * math.sin(2 * B)  # H'(0) of the support function H(a) = 18 + 5 cos(a - b) + cos(2 a - 2 b)
RADIUS = 18 - 3 * math.cos(2 * B)  # H(0) + H''(0)


def judge(run):
    pair = run.pair("foot")
    near("force of the spring", -pair["force"][2], FORCE, relative=1e-9)
    near("force along the foot", pair["force"][0], 0, absolute=1e-9 * FORCE)
    near("force on the shaft", run.summary["reactions"]["cam:top"][2], -FORCE, relative=1e-9)
    table = run.table("foot")
    x, f, p = (np.array(table[key]) for key in ("x", "force", "pressure"))
    near("lever about the shaft", (f * x).sum() / f.sum(), LEVER, absolute=0.02)  # the cam gives way by hundredths of a millimetre
    half = math.sqrt(4 * FORCE / WIDTH * RADIUS / (math.pi * MODULUS))
    near("largest pressure", pair["max_pressure"], 2 * FORCE / WIDTH / (math.pi * half), relative=1e-2)
    near("half width from the area", pair["area"] / WIDTH / 2, half, relative=0.1)
    middle = np.isclose(table["y"], WIDTH / 2)
    near("the same along the whole line", p[~middle].max(), p[middle].max(), relative=1e-6)
