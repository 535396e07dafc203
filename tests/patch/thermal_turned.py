"""An orthotropic plate that is free takes its thermal strain, turned with the axes of its material, without stress."""
import math

from judge import near

C, S = math.cos(math.radians(30)), math.sin(math.radians(30))
LINE = (-0.4, 0.3)


def judge(run):
    for order, temperature in (("1", "50"), ("2", "50"), ("2", "10+20*x-30*y")):
        other = run.again("-order", order, "-a_temperature", temperature, name=f"order{order}_{len(temperature)}")
        near("stress", other.probe("p")["stress"], [0] * 6, absolute=1e-12 * 400 * 4e-5 * 50)
        near("energy", other.summary["energy"]["strain"]["a"], 0, absolute=1e-15)
        if temperature == "50":
            apart = [q - p for p, q in zip(other.probe("p")["displacement"], other.probe("q")["displacement"])]
            along, across = C * LINE[0] + S * LINE[1], -S * LINE[0] + C * LINE[1]
            near("extension", sum(a * d for a, d in zip(LINE, apart)), 50e-5 * (along**2 + 4 * across**2), relative=1e-11)
