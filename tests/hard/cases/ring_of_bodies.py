"""What presses on the third body is carried by the two others; sides that stand upright push sideways only."""
from judge import near


def judge(run):
    carried = sum(abs(run.pair(name)["force"][1]) for name in ("bc", "ca"))
    near("force on both", carried, 2, absolute=1e-9)
    near("between both, along y", run.pair("ab")["force"][1], 0, absolute=1e-12)
