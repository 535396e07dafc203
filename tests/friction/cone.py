"""All of the seat slips while the plug is pressed in: N (sin a + mu cos a) is the force, tan a = 0.1 the slope. Let go, the plug comes out where mu < tan a.
Forces and displacements are then rounding of those of the first step, on every mesh. With mu > tan a it stays, and the seat takes no axial force."""
import math

from judge import near, require

PUSH, SLOPE = 1000, math.atan(0.1)


def judge(run):
    for friction, other in ((0.05, run), (0.2, run.again("-seat_friction", "0.2", name="locked", warns=["not_unique"]))):
        pressed, free = (step["pairs"]["seat"] for step in other.summary["steps"])
        force = PUSH / (math.sin(SLOPE) + friction * math.cos(SLOPE))
        near("pressed", pressed["normal_force"], force, relative=1e-9)
        near("axial force", pressed["force"][1], PUSH, relative=1e-9)
        near("axial force, let go", free["force"][1], 0, absolute=1e-9 * force)
        if friction > 0.1:
            require(free["normal_force"] > 0.5 * force, f"nothing presses: {free['normal_force']}")
        else:
            near("let go", free["normal_force"], 0, absolute=1e-12 * force)
