"""Bars do not depend on where the origin is: the same plates at x = 0 have the same ones."""
from judge import near

PLACE = ("-upper_dm_plex_box_lower", "0,0", "-upper_dm_plex_box_upper", "1,1", "-lower_dm_plex_box_lower", "0,-1", "-lower_dm_plex_box_upper", "1,0",
         "-probe_corner_at", "1,0", "-probe_middle_at", "0.5,0.3")


def judge(run):
    far, here = run.summary["bars"]["pairs"]["joint"], run.again(*PLACE, name="here").summary["bars"]["pairs"]["joint"]
    for name in ("force", "area", "max_pressure", "min_gap", "centre_of_pressure"):
        near(f"bar of {name}", far[name], here[name], relative=1e-6, absolute=1e-9)
