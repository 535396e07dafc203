"""The plane scene with the same cells: forces, energy, nodes in contact."""
from twins import judge_slab

PLANE = {
    "upper_dm_plex_box_faces": "8,2",
    "upper_dm_plex_box_lower": "0,0",
    "upper_dm_plex_box_upper": "8,0.002",
    "upper_bc_normal": "left",
    "upper_bc_traction_top": "0,0-1-x/8",
    "lower_dm_plex_box_faces": "50,2",
    "lower_dm_plex_box_lower": "0,-1",
    "lower_dm_plex_box_upper": "8,0",
    "lower_bc_displacement_bottom": "0,0",
}


def judge(run):
    judge_slab(run, PLANE, 2)
