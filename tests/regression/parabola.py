"""R4b: a block under a rigid parabola; half-width within a local mesh width, force by the independent high-order reference."""
from judge import near

FORCE = {0.005: 1.939570, 0.01: 4.254231, 0.02: 9.431822, 0.04: 21.197056}
HALF_WIDTH = {0.005: 0.047394, 0.01: 0.070172, 0.02: 0.104425, 0.04: 0.156349}


def judge(run):
    for depth, force in FORCE.items():
        again = run.again("-joint_obstacle_point", f"0,{-depth}", name=f"depth{depth}")
        near(f"force at {depth}", again.pair("joint")["normal_force"], force, relative=1e-2)
        table = again.table("joint")
        touching = [abs(x) for x, status in zip(table["x"], table["status"]) if status == 1]
        beyond = min(abs(x) for x in table["x"] if abs(x) > max(touching) + 1e-12)
        near(f"half-width at {depth}", max(touching), HALF_WIDTH[depth], absolute=beyond - max(touching) + 1e-9)
