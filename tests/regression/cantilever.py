"""A slender cantilever: hexahedra and tetrahedra of second order against beam theory."""
from judge import near

FORCE, LENGTH, WIDTH, HEIGHT, YOUNG = 1.2, 10.0, 0.6, 1.0, 1e5
BENDING = FORCE * LENGTH**3 / (3 * YOUNG * WIDTH * HEIGHT**3 / 12)
SHEAR = 6 / 5 * FORCE * LENGTH / (YOUNG / 2 * WIDTH * HEIGHT)


def judge(run):
    for again in (run, run.again("-beam_dm_plex_simplex", "1", name="tetrahedra")):
        near("deflection", again.probe("tip")["displacement"][2], BENDING + SHEAR, relative=5e-4)
        near("reaction", again.summary["reactions"]["beam:left"], [0, 0, -FORCE], absolute=1e-9)
