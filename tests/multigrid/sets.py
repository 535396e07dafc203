"""Meshes whose active set differs from that of the next coarser one at some ten nodes, also after one system. The prediction before the
first system must find the set, up to what one system corrects."""
from judge import require

SETS = 2
MESHES = [("3,3,3", "2,2,2", 3), ("11,11,11", "9,9,9", 1)]


def judge(run):
    for upper, lower, levels in MESHES:
        mesh = ["-upper_dm_plex_box_faces", upper, "-lower_dm_plex_box_faces", lower, "-dm_refine", str(levels)]
        solver = run.again(*mesh, "-pc_type", "truncatedmg", name=f"cells{levels}").summary["solver"]
        require(solver["iterations"] <= SETS, f"{solver['iterations']} sets with cells {upper} refined {levels} times")
