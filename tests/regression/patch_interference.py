"""X1: overlap of 1e-3 between confined blocks; the pressure follows from two springs in series, exact on any mesh."""
from judge import near

PRESSURE = 0.979782270606


def judge(run):
    for again in (run, run.again("-lower_dm_plex_box_faces", "7,3", "-upper_dm_plex_simplex", "1", name="triangles"),
                  run.again("-snes_type", "vinewtonrsls", name="vinewtonrsls")):
        table = again.table("joint")
        near("pressure", table["pressure"], [PRESSURE] * len(table["pressure"]), relative=1e-11)
