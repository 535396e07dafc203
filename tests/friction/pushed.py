"""Friction that a prescribed displacement takes from a node is told, with its part of the area; where nothing moves along the partner, none is lost."""
from judge import require, same


def judge(run):
    (warning,) = run.summary["warnings"]
    same("warned of", [warning["code"], warning["pair"], warning["at"]], ["held_friction", "floor", [0, 0]])
    require("8.33 % of its area" in warning["text"], warning["text"])
    run.again("-block_bc_displacement_left", "0,free", name="still", warns=set())
