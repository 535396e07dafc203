"""Total force and moment on a part of a circle: what nodal loads and reactions add up to."""
import math

from judge import near


def judge(run):
    for order in "12":
        other = run.again("-order", order, name=f"order{order}")
        load, traction = (other.summary["loads"][side] for side in ("arch:right", "arch:left"))
        near("force", load["force"], [3, -5], absolute=1e-12)
        near("moment", load["moment"], 2, absolute=1e-12)
        near("reaction", other.summary["reactions"]["arch:bottom"], [-3 - traction["force"][0], 5], relative=1e-11)
        # order 1 has five chords of the angle 0.26
        arc, radius = (10 * 2 * math.sin(0.13), 2 * math.cos(0.13) * math.sin(0.65) / (5 * math.sin(0.13))) if order == "1" else (2.6, 2 * math.sin(0.65) / 0.65)
        near("arc", load["area"], 0.5 * arc, relative=1e-12 if order == "1" else 1e-5)
        near("centroid", math.hypot(*load["centroid"]), radius, relative=1e-12 if order == "1" else 1e-5)
        near("traction", traction["force"], [traction["area"], 0], relative=1e-12)
