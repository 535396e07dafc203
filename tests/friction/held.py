"""Friction that is lost at a held node is told, with its place; with the roles exchanged, and on a plane of symmetry of both blocks, nothing is lost, unless one moves."""
from judge import require, same


def judge(run):
    (warning,) = run.summary["warnings"]
    same("warned of", [warning["code"], warning["pair"], warning["at"]], ["held_friction", "joint", [0, 0]])
    require("at 1 node in" in warning["text"], warning["text"])
    run.again("-joint_nonmortar", "lower:top", "-joint_mortar", "upper:bottom", name="exchanged", warns=set())
    run.again("-lower_dm_plex_box_lower", "0,-1", "-lower_bc_normal", "left", "-lower_bc_displacement_bottom", "0,0", name="half", warns=set())
    run.again("-upper_map", "x,y", "-lower_map", "x,y", "-lower_dm_plex_box_lower", "0,-1", "-lower_bc_displacement", "left,bottom",
              "-lower_bc_displacement_left", "1e-3,free", "-lower_bc_displacement_bottom", "1e-3,0", name="moved", warns={"held_friction"})
