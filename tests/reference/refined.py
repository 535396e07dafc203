"""Systems of linear equations to the last digit, for matrices that leave few."""
import numpy as np


def solve_refined(A, b):
    """A x = b for one or several b, the residual taken in extended precision."""
    inverse, x = np.linalg.inv(A.astype(float)), np.zeros(np.shape(b), dtype=np.longdouble)
    for _ in range(4):
        x = x + inverse @ np.asarray(b - A.astype(np.longdouble) @ x, dtype=float)
    return x.astype(float)
