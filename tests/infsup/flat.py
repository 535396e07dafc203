"""The only pair of the scene: four meshes of order 1 and of order 2."""
from flatness import numbers, require_flat


def judge(run):
    (pair,) = run.summary["pairs"]
    for order in ("1", "2"):
        require_flat(f"order {order}", numbers(run, pair, 4, "-order", order), 0.05)
