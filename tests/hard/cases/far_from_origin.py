"""The same at the origin."""
from judge import near


def judge(run):
    here = run.again("-upper_dm_plex_box_lower", "0,0", "-upper_dm_plex_box_upper", "1,1", "-lower_dm_plex_box_lower", "-1,-1", "-lower_dm_plex_box_upper", "2,0", "-upper_bc_traction_top", "0,0-1-x", name="here")
    near("force", run.pair("joint")["force"], [0, 1.5], absolute=1e-8)
    near("potential", run.summary["energy"]["potential"], here.summary["energy"]["potential"], relative=1e-8)
    near("pressure", sorted(run.table("joint")["pressure"]), sorted(here.table("joint")["pressure"]), relative=1e-7)
