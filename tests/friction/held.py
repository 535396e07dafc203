"""A support holds a corner along a partner that is drawn along: friction is that of the exchanged roles, whose nodes are not held. Planes of symmetry keep their nodes."""
from math import hypot

from judge import near, same


def judge(run):
    exchanged = run.again("-joint_nonmortar", "lower:top", "-joint_mortar", "upper:bottom", name="exchanged", warns=set())
    force = [-hypot(*one.summary["pairs"]["joint"]["tangential_force"]) for one in (run, exchanged)]
    near("friction", force[0], force[1], relative=1e-2)  # 10 % more without friction at the corner
    same("nodes in contact", run.summary["pairs"]["joint"]["active_nodes"], 5)
    half = run.again("-lower_dm_plex_box_lower", "0,-1", "-lower_bc_normal", "left", "-lower_bc_displacement_bottom", "0,0", name="half", warns=set())
    same("nodes in contact", half.summary["pairs"]["joint"]["active_nodes"], 6)
    moved = run.again("-upper_map", "x,y", "-lower_map", "x,y", "-lower_dm_plex_box_lower", "0,-1", "-lower_bc_displacement", "left,bottom",
                      "-lower_bc_displacement_left", "1e-3,free", "-lower_bc_displacement_bottom", "1e-3,0", name="moved", warns=set())
    same("nodes in contact", moved.summary["pairs"]["joint"]["active_nodes"], 5)
