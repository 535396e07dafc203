"""Meshes whose active set differs from that of the next coarser one at some ten nodes, also after one system. The prediction before the
first system must find the set, up to what one system corrects. So it must on a first level that is too large to be factored, and exactly on
some mesh with one level."""
import re

from judge import require

SETS = 2
MESHES = [("3,3,3", "2,2,2", 3), ("11,11,11", "9,9,9", 1)]
LARGE = ("13,13,13", "11,11,11", 1)  # 13,416 unknowns of the first level; from no contact it takes five sets
ONE = ["-upper_dm_plex_box_faces", "17,17,17", "-lower_dm_plex_box_faces", "13,13,13", "-upper_dm_plex_simplex", "1", "-lower_dm_plex_simplex", "1"]


def boxes(upper, lower, levels):
    return ["-upper_dm_plex_box_faces", upper, "-lower_dm_plex_box_faces", lower, "-dm_refine", str(levels), "-pc_type", "truncatedmg"]


def judge(run):
    for mesh in MESHES:
        solver = run.again(*boxes(*mesh), name=f"cells{mesh[2]}").summary["solver"]
        require(solver["iterations"] <= SETS, f"{solver['iterations']} sets with cells {mesh[0]} refined {mesh[2]} times")
    large = run.again(*boxes(*LARGE), "-nested_snes_monitor", name="large")
    sets = [int(number) for number in re.findall(r"^ *(\d+) SNES Function norm", large.stdout, re.MULTILINE)]
    require(sets and max(sets) <= SETS, f"sets of the first level: {sets}")
    require(large.summary["solver"]["iterations"] <= SETS, f"{large.summary['solver']['iterations']} sets")
    one = run.again(*ONE, "-pc_type", "truncatedmg", name="one").summary["solver"]
    require(one["iterations"] == 1, f"{one['iterations']} sets on a mesh with one level")
