"""Meshes where the set that the next coarser one suggests is wrong at some ten nodes, and still wrong after one system that starts from it: what goes
ahead of the first system has to find the set, or all but what one system mends."""
from judge import require

SETS = 2
MESHES = [("3,3,3", "2,2,2", 3), ("11,11,11", "9,9,9", 1)]


def judge(run):
    for upper, lower, levels in MESHES:
        mesh = ["-upper_dm_plex_box_faces", upper, "-lower_dm_plex_box_faces", lower, "-dm_refine", str(levels)]
        solver = run.again(*mesh, "-pc_type", "truncatedmg", name=f"cells{levels}").summary["solver"]
        require(solver["iterations"] <= SETS, f"{solver['iterations']} sets with cells {upper} refined {levels} times")
