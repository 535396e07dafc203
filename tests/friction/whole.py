"""A symmetric scene with friction, and half of it, whose supports hold nodes of both sides along the joint. Both have the same numbers, and no
friction is missed there."""
from judge import near, require

HALF = {2: ("-upper_dm_plex_box_faces", "8,6", "-lower_dm_plex_box_faces", "9,6", "-upper_dm_plex_box_lower", "0,0", "-lower_dm_plex_box_lower", "0,-1",
            "-upper_bc_normal", "left", "-lower_bc_normal", "left"),
        3: ("-upper_dm_plex_box_faces", "4,4,3", "-lower_dm_plex_box_faces", "3,3,3", "-upper_dm_plex_box_lower", "0,0,0", "-lower_dm_plex_box_lower", "0,0,-1",
            "-upper_bc_normal", "left,front", "-lower_bc_normal", "left,front")}


def judge(run):
    half = run.again(*HALF[run.summary["scene"]["dimension"]], name="half", warns=set())
    whole, part = run.pair("joint"), half.pair("joint")
    for key, factor in (("normal_force", 2), ("area", 2), ("dissipation", 2), ("max_slip", 1), ("slip_share", 1), ("max_pressure", 1)):
        near(key, factor * part[key], whole[key], relative=1e-8)
    near("potential", 2 * half.summary["energy"]["potential"], run.summary["energy"]["potential"], relative=1e-10)
    require(0.05 < part["slip_share"] < 0.95, f"{part['slip_share']} of the area slips")
