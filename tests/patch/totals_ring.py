"""A total force on a ring: the stress of the whole section."""
import math

from judge import near


def judge(run):
    for order in "12":
        other = run.again("-order", order, name=f"order{order}")
        near("stress", other.probe("p")["stress"], [0, 90 / (8 * math.pi), 0, 0, 0, 0], absolute=1e-11)
        load = other.summary["loads"]["tube:top"]
        near("force", load["force"], [0, 90], absolute=1e-11)
        near("area", load["area"], 8 * math.pi, relative=1e-13)
        near("reaction", other.summary["reactions"]["tube:bottom"], [0, -90], absolute=1e-10)
