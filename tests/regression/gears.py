"""Two pairs of teeth of an involute gear: their forces are equal and along the line of action, pressures are Hertz's. Forces are also those of
-adapt 3e-3, whose bars are 0.005."""
import math

from judge import near

MODULUS, ANGLE = 210000 / (2 * (1 - 0.3**2)), math.radians(20)
REACH, HALF = 20 * math.sin(ANGLE), math.pi * 2 * math.cos(ANGLE) / 2  # from a base circle to the pitch point; half a base pitch
RADIUS = (REACH - HALF) * (REACH + HALF) / (2 * REACH)


def judge(run):
    first, second = run.pair("first"), run.pair("second")
    near("forces of both pairs", first["normal_force"], second["normal_force"], relative=1e-3)
    for pair, finest in ((first, 105.715), (second, 105.645)):
        near("line of action", pair["force"][0] / pair["force"][1], math.tan(ANGLE), relative=3e-4)
        near("force", pair["normal_force"], finest, relative=3e-3)
        near("largest pressure", pair["max_pressure"], math.sqrt(pair["normal_force"] * MODULUS / (math.pi * RADIUS)), relative=5e-3)
