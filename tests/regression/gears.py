"""Two pairs of teeth of an involute gear: their forces are along the line of action, pressures are Hertz's. Forces are also those of
-adapt 3e-3, whose bars are 0.005. They are equal if both hubs turn by half: then a half turn about the pitch point changes nothing."""
import math

from judge import near

MODULUS, ANGLE = 210000 / (2 * (1 - 0.3**2)), math.radians(20)
REACH, HALF = 20 * math.sin(ANGLE), math.pi * 2 * math.cos(ANGLE) / 2  # from a base circle to the pitch point; half a base pitch
RADIUS = (REACH - HALF) * (REACH + HALF) / (2 * REACH)


def judge(run):
    first, second = run.pair("first"), run.pair("second")
    half = run.again(*(text for hub, centre in (("driver", "x+20"), ("driven", "x-20"))
                       for text in (f"-{hub}_bc_displacement_{hub}_hub", f"-2.5e-4*y, 2.5e-4*({centre})")))
    near("forces of both pairs", half.pair("first")["normal_force"], half.pair("second")["normal_force"], relative=2e-4)
    for pair, finest in ((first, 105.715), (second, 105.645)):
        near("line of action", pair["force"][0] / pair["force"][1], math.tan(ANGLE), relative=3e-4)
        near("force", pair["normal_force"], finest, relative=3e-3)
        near("largest pressure", pair["max_pressure"], math.sqrt(pair["normal_force"] * MODULUS / (math.pi * RADIUS)), relative=5e-3)
