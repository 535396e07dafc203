"""A block that is pressed on, lifted, moved and pressed on again. Nothing drags it. Both methods agree while it is apart, by multigrid, too. The
second one found no solution there (warning not_confirmed): limits at open nodes were those of roundoff."""
from judge import near


def judge(run):
    forces = [step["pairs"]["joint"] for step in run.summary["steps"]]
    pressed = forces[0]["normal_force"]
    near("pressed again", [pair["normal_force"] for pair in forces[1:]], [0, 0, pressed], absolute=1e-7 * pressed)
    near("dragged", [pair["tangential_force"][0] for pair in forces], [0] * 4, absolute=1e-7 * pressed)
