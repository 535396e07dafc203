"""A parallelogram with the corner's angle, pressed from its other sides."""
from math import cos, radians, sin

from judge import same
from uniform import judge_uniform


def judge(run):
    for angle in (100, 25, 60, 155, 170) if run.ranks == 1 else (170,):  # normals at a node are no matter of ranks
        c, s = cos(radians(angle)), sin(radians(angle))
        turned = ["-block_map", f"x+({c!r})*y, {s!r}*y", "-wall_obstacle_normal", f"{s!r},{-c!r}"]
        for order in "12":
            judge_uniform(run.again(*turned, "-order", order, name=f"angle{angle}_{order}"), ["floor", "wall"])
    for pair, nodes in (("floor", 6), ("wall", 5)):
        same(f"nodes of {pair}", run.pair(pair)["active_nodes"], nodes)
