"""8 facets on 6, on any number of ranks: the number of pairing.py. Poisson's ratio and moduli are part of it, units are not."""
from flatness import number
from judge import near, require
import pairing

MATERIALS = ((8e9, 8e9, 0.3), (8e9, 8e12, 0.3), (8e12, 8e9, 0.3), (1.0, 5.0, 0.45))


def judge(run):
    for upper, lower, poisson in MATERIALS:
        materials = ["-upper_young", str(upper), "-lower_young", str(lower), "-upper_poisson", str(poisson), "-lower_poisson", str(poisson)]
        other = run.again(*materials, name=f"{upper:g}_{lower:g}")
        near(f"E = {upper:g}, {lower:g}", number(other, "joint"),
             pairing.number("dual", 8, 6, young=(upper, lower), poisson=poisson, lumped=True), relative=1e-7)
    thick = run.again("-thickness", "20", name="thick")
    near("a thickness", number(thick, "joint"), number(run, "joint"), relative=1e-9)
    plain = run.again("-infsup", "0", name="plain")
    require("inf_sup" not in plain.pair("joint") and "inf-sup" not in plain.stdout, "a number that nobody asked for")
