"""Full coverage: finer and coarser mortar sides, triangles, stiffness ratios 1e6 both ways, either solver."""
from uniform import uniform


def judge(run):
    uniform(run)
    uniform(run.again("-lower_dm_plex_box_faces", "7,2", name="finer"))
    uniform(run.again("-upper_dm_plex_simplex", "1", "-lower_dm_plex_box_faces", "7,3", name="triangles"))
    uniform(run.again("-snes_type", "vinewtonrsls", name="vinewtonrsls"))
    for young in ("1e3", "1e15"):  # 1e9 in the other body
        uniform(run.again("-upper_young", young, name=f"upper{young}"), tolerance=1e-9)
