"""Reactions of planes that meet at any angle. Each node of two or three planes gives to each its own part. This holds also where the lower one
is clamped and two sides fix the same direction."""
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
    strain = -PRESSURE * (0.5 if dimension == 3 else 0.625) / 3e3
    clamped = ["-block_bc_displacement", "bottom", "-block_bc_displacement_bottom", ",".join(f"{strain}*{x}" for x in "xyz"[:dimension])]
    clamped += ["-block_bc_normal", "left,front"] if dimension == 3 else []
    turned = ["-block_bc_normal", "bottom,left,front"] if dimension == 3 else []
    for options in ([], ["-order", "2"], ["-block_dm_plex_simplex", "1", *turned], clamped, [*clamped, "-order", "2"], [*clamped, "-block_dm_plex_simplex", "1"]):
        reactions = run.again(*options, name="again").summary["reactions"]
        for side, area in areas(dimension).items():
            near(side, reactions[f"block:{side}"], [PRESSURE * part for part in area], absolute=1e-12)
