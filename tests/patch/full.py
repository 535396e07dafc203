"""Full coverage: both orders, finer and coarser mortar sides, triangles, stiffness ratios 1e6 both ways, either solver."""
from uniform import uniform


def judge(run):
    uniform(run)
    uniform(run.again("-lower_dm_plex_box_faces", "7,2", name="finer"))
    uniform(run.again("-upper_dm_plex_simplex", "1", "-lower_dm_plex_box_faces", "7,3", name="triangles"))
    for orders in run.some([["-order", "2"], ["-upper_order", "2"], ["-lower_order", "2"]]):
        uniform(run.again(*orders, name="orders"))
        uniform(run.again(*orders, "-upper_dm_plex_simplex", "1", "-lower_dm_plex_box_faces", "7,3", name="orders of triangles"))
        uniform(run.again(*orders, "-joint_nonmortar", "lower:top", "-joint_mortar", "upper:bottom", name="orders swapped"))
    uniform(run.again("-snes_type", "vinewtonrsls", name="vinewtonrsls"))
    uniform(run.again("-upper_young", "1e3", name="soft"), tolerance=1e-9)
    uniform(run.again("-upper_young", "1e3", "-joint_nonmortar", "lower:top", "-joint_mortar", "upper:bottom", name="swapped"), tolerance=1e-9)
    # a stiff body that rides on a soft one moves 1e6 times its own strain: roundoff of its displacement is some 1e-9 of its stress
    uniform(run.again("-upper_young", "1e15", name="riding"), tolerance=1e-8)
