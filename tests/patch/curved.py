"""Curved quads, curved triangles, either solver: isoparametric cells hold linear displacements whatever their shape."""
from hydrostatic import hydrostatic


def judge(run):
    hydrostatic(run)
    hydrostatic(run.again("-upper_dm_plex_simplex", "1", "-lower_dm_plex_box_faces", "7,3", name="triangles"))
    hydrostatic(run.again("-lower_dm_plex_simplex", "1", name="below"))
    hydrostatic(run.again("-snes_type", "vinewtonrsls", name="vinewtonrsls"))
