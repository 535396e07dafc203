"""Boxes get coarser levels where multigrid needs them. The answer is that of a factorization on the same mesh: bricks and triangles, refined by
body, by scene and by a study.
"""
from judge import LONG, near, same

WAYS = {
    "boxes": [],
    "triangles": ["-lower_dm_plex_simplex", "1"],
    "refined": ["-upper_dm_plex_box_faces", "16,16", "-upper_dm_refine", "1", "-lower_dm_plex_box_faces", "24,24", "-dm_refine", "1"],
    "mapped": ["-upper_map", "x, y+0.1*x*y"],
}


def judge(run):
    for name, options in WAYS.items():
        direct = run.again(*options, "-pc_type", "cholesky", name=name)
        for ranks in (1, 2) if LONG or name == "refined" else (1,):
            levels = run.again(*options, "-pc_type", "truncatedmg", "-snes_rtol", "1e-10", ranks=ranks, name=f"{name}_levels{ranks}")
            near(f"energy of {name}", levels.summary["energy"]["potential"], direct.summary["energy"]["potential"], relative=1e-9)
            for what in ("normal_force", "active_nodes"):
                near(f"{what} of {name}", levels.pair("joint")[what], direct.pair("joint")[what], relative=1e-8)
            for body in ("upper", "lower"):
                same(f"nodes of {name}", levels.summary["scene"]["bodies"][body]["nodes"], direct.summary["scene"]["bodies"][body]["nodes"])
