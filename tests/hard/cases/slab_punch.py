"""The plane scene with the same cells: forces, energy, nodes in contact."""
from twins import judge_slab

PLANE = {
    "punch_dm_plex_box_faces": "6,4",
    "punch_dm_plex_box_lower": "0.3,0",
    "punch_dm_plex_box_upper": "0.7,0.4",
    "punch_bc_traction_top": "0,0-1-x",
    "block_dm_plex_box_faces": "16,8",
    "block_dm_plex_box_lower": "0,-0.5",
    "block_dm_plex_box_upper": "1,0",
    "block_bc_displacement_bottom": "0,0",
}


def judge(run):
    judge_slab(run, PLANE, 3)
