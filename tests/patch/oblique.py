"""Reactions of planes that meet at any angle: each node of two or three planes gives to each its own part."""
import numpy as np

from judge import near

PRESSURE = 5
EDGES = np.array([[1, 0, 0], [0.36, 1.2, 0], [0.16, 0.08, 0.8]])  # of the block


def areas(dimension):
    """Side: inward normal times area."""
    if dimension == 2:
        return {"left": [1.2, -0.36], "bottom": [0, 1]}
    return {side: np.cross(EDGES[i], EDGES[j]) for side, (i, j) in {"left": (1, 2), "front": (2, 0), "bottom": (0, 1)}.items()}


def judge(run):
    dimension = run.summary["scene"]["dimension"]
    turned = ["-block_bc_normal", "bottom,left,front"] if dimension == 3 else []
    for options in ([], ["-order", "2"], ["-block_dm_plex_simplex", "1", *turned]):
        reactions = run.again(*options, name="again").summary["reactions"]
        for side, area in areas(dimension).items():
            near(side, reactions[f"block:{side}"], [PRESSURE * part for part in area], absolute=1e-12)
