"""A file of second order under a body of order 1 that is not the first body, or twice in one scene with different maps: Lame's pressure, refined once.

All cells of the file's curves were taken for those of the first body. After a box its map was used, or the program failed (exit codes 1 and 4). A second copy had
the map of the first one, and met nothing.
"""
import roundmesh
from judge import near
from scenes import Findings, Scene

YOUNG, POISSON, FIT, OVERLAP = 1e3, 0.3, 2, 1e-3  # the hub's outer side, held, has twice the radius


def lame(hollow):
    """The pressure between a disc, or a ring of half its radius, and a hub that is held outside, in plane strain."""
    young, poisson = YOUNG / (1 - POISSON**2), POISSON / (1 - POISSON)
    within = (5 / 3 if hollow else 1) - poisson
    without = (1 - poisson**2) * 3 / (1 + poisson + 4 * (1 - poisson))
    return OVERLAP * young / FIT / (within + without)


def fit(folder, hollow):
    scene = Scene()
    ring = roundmesh.ring(FIT / 2, FIT, 24, 4, 2)
    held = {"bc_displacement": "outer", "bc_displacement_outer": "0,0", "map": "2*x, 2*y"}
    if hollow:
        scene.file("shaft", ring, folder, young=YOUNG)
    else:
        scene.roller("shaft", FIT, 8, (0, 0), young=YOUNG)
    scene.file("hub", ring, folder, young=YOUNG, **held)
    scene.joint("fit", "hub:inner", "shaft:outer" if hollow else "shaft:bottom+left+right+top")
    scene.give(fit_gap=-OVERLAP, dm_refine=1)
    return scene


def judge(run):
    found = Findings()
    for name, hollow in (("after_a_box", False), ("two_copies", True)):
        with found.case():
            done = fit(run.folder / "meshes" / name, hollow).solve(run, name)
            near(f"{name}: mean pressure", done.pair("fit")["mean_pressure"], lame(hollow), relative=5e-3)
    found.end()
