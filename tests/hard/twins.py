"""Two ways to say the same scene."""
import math

from judge import near, require, same_table


def constrained(table):
    """The rows of nodes with a multiplier."""
    rows = [place for place, status in enumerate(table["status"]) if status >= 0]
    return {column: [values[place] for place in rows] for column, values in table.items()}


def judge_twin(run, twin, relative=1e-10):
    """The same multipliers, gaps and energy; where only one of the two has a node or a multiplier, nothing presses."""
    mine, other = constrained(run.table("joint")), constrained(twin.table("joint"))
    require(mine["x"] and len(mine["x"]) == len(other["x"]), f"{len(mine['x'])} multipliers instead of {len(other['x'])}")
    size = max(map(abs, other["gap"]))
    same_table(mine, other, {"pressure": (relative, 0), "gap": (0, relative * size), "status": (0, 0)})
    near("energy", run.summary["energy"]["potential"], twin.summary["energy"]["potential"], relative=relative)
    require(math.isfinite(size), "a gap is not a number")
