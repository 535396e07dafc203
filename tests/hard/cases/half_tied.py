from cases import judge_sound
from judge import near, require


def judge(run):
    """The gap of the twin is the broken line through its nodes' gaps, less what was left of them."""
    table = run.table("joint")
    nodes = sorted(zip(table["x"], table["gap"], table["pressure"]))
    filled = [(x, 0.02 * max(0, abs(x) - 0.25) - max(left, 0)) for x, left, _ in nodes]
    pieces = [f"(x<{end[0]:.17g}?{begin[1]:.17g}+{(end[1] - begin[1]) / (end[0] - begin[0]):.17g}*(x-({begin[0]:.17g})):" for begin, end in zip(filled, filled[1:])]
    gap = "".join(pieces) + f"{filled[-1][1]:.17g}" + ")" * len(pieces)
    twin = run.again("-joint_gap", gap, name="filled")
    judge_sound(twin)
    pressed, other = sorted(zip(table["x"], table["pressure"])), sorted(zip(twin.table("joint")["x"], twin.table("joint")["pressure"]))
    near("pressures", [p for _, p in other], [p for _, p in pressed], absolute=1e-9 * max(table["pressure"]))
    near("gaps", twin.table("joint")["gap"], [0] * len(nodes), absolute=1e-12)
    require(sum(p < 1e-9 for _, _, p in nodes) >= len(nodes) // 3, "most nodes press")
