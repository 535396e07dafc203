"""Numbers of an iterative solution on one and on three ranks: they differ by at most 1e-9 of the largest of their kind. A component that is
small beside the others has fewer digits of its own."""
from judge import near, same

ALLOWED = 1e-9


def judge(run):
    other = run.again(ranks=3, name="ranks3")
    mine, theirs = run.summary["reactions"], other.summary["reactions"]
    largest = max(abs(force) for forces in mine.values() for force in forces)
    for side, forces in mine.items():
        near(f"reaction of {side}", theirs[side], forces, absolute=ALLOWED * largest)
    for pair in run.summary["pairs"]:
        same(f"active nodes of {pair}", other.pair(pair)["active_nodes"], run.pair(pair)["active_nodes"])
        near(f"force of {pair}", other.pair(pair)["force"], run.pair(pair)["force"], absolute=ALLOWED * run.pair(pair)["normal_force"])
        for number in ("normal_force", "area", "max_pressure"):
            near(f"{number} of {pair}", other.pair(pair)[number], run.pair(pair)[number], relative=ALLOWED)
