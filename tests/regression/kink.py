"""M2 with order 2: its body forces have a kink at x = 0.55, within a column of cells of these meshes. Integrated by parts of these cells
the error in L2 keeps its order. With one rule for a whole cell it is erratic, and several times larger.

LISTED: what an independent prototype, with multipliers of another kind, has on the same meshes (n x n cells above, 3n/2 x 3n/2 below).
"""
import math

from judge import require

LISTED = {"quads": {16: 3.8676e-05, 32: 1.1935e-05}, "triangles": {16: 1.0705e-05, 32: 3.9483e-06}}
ALLOWED = 1.05
ORDER, SPREAD = 3, 0.1


def judge(run):
    for cells, known in LISTED.items():
        simplex = "01"[cells == "triangles"]
        found = []
        for n, listed in known.items():
            faces = ["-upper_dm_plex_box_faces", f"{n},{n}", "-lower_dm_plex_box_faces", f"{3 * n // 2},{3 * n // 2}"]
            again = run.again(*faces, "-upper_dm_plex_simplex", simplex, "-lower_dm_plex_simplex", simplex, name=f"{cells}{n}")
            found.append(again.summary["errors_total"]["l2"])
            require(found[-1] <= ALLOWED * listed, f"L2 error of {cells} at n = {n}: {found[-1]:.4g}, listed {listed:.4g}")
        order = math.log2(found[0] / found[1])
        require(abs(order - ORDER) <= SPREAD, f"order of the L2 error of {cells}: {order:.3f}")
