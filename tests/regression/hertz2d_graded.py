"""Hertz' pressure for the force found, of which this half carries one half, on curved cells of both orders."""
import math

from judge import near

MODULUS = 1 / ((1 - 0.3**2) / 210000 + (1 - 0.33**2) / 70000)
RADIUS = 10
FINITE = 2e-3  # by which half planes differ from a disc and a block of this size: (half width / radius)^2


def judge(run):
    for order in ("1", "2"):
        again = run.again("-order", order, "-dm_refine", "1", name=f"order{order}")
        pair = again.pair("joint")
        force = 2 * pair["force"][1]
        near(f"largest pressure of order {order}", pair["max_pressure"], math.sqrt(force * MODULUS / (math.pi * RADIUS)), relative=FINITE)
        near(f"half width of order {order}", pair["extent"]["upper"][0], math.sqrt(4 * force * RADIUS / (math.pi * MODULUS)), relative=0.05)
