"""A shrink fit of two rings from files of second order, refined: Lame's pressure everywhere, with facets of 15 and 18 degrees and an overlap of R/2000.

Refined along the files' parabolas, the largest pressure is 7 times Lame's after four refinements, the mean 1.17 times; pressures grow with each refinement.
"""
import numpy as np
import roundmesh
from judge import LONG, near, same
from scenes import Findings, Scene

YOUNG, POISSON, INSIDE, FIT, OUTSIDE, OVERLAP = 1e3, 0.3, 1, 2, 3, 1e-3


def lame():
    """The pressure between a ring that is free inside and a ring that is held outside, in plane strain."""
    young, poisson = YOUNG / (1 - POISSON**2), POISSON / (1 - POISSON)
    within = FIT / young * ((FIT**2 + INSIDE**2) / (FIT**2 - INSIDE**2) - poisson)
    square = OUTSIDE**2 / FIT**2
    around = FIT / young * (1 - poisson**2) * (square - 1) / (1 + poisson + square * (1 - poisson))
    return OVERLAP / (within + around)


def rings(folder, order, swapped):
    scene = Scene(order=order)
    scene.file("shaft", roundmesh.ring(INSIDE, FIT, 20, 2, 2, 0.1), folder, young=YOUNG)
    scene.file("hub", roundmesh.ring(FIT - OVERLAP, OUTSIDE, 24, 2, 2, 0.33), folder, young=YOUNG, bc_displacement="outer", bc_displacement_outer="0,0")
    scene.joint("joint", "hub:inner", "shaft:outer", swapped=swapped)
    return scene


def judge(run):
    found = Findings()
    cases = {"uniform": ("-dm_refine", "2"), "own": ("-shaft_dm_refine", "2", "-hub_dm_refine", "2")}
    cases |= {"cut": ("-adapt", "2e-2"), "kept": ("-adapt", "2e-2", "-adapt_cells", "kept")}
    for name, words in cases.items():
        for order in (1, 2):
            for swapped in (False, True) if LONG else (order == 2,):
                with found.case():
                    called = f"{name}_{order}{'_swapped' if swapped else ''}"
                    done = rings(run.folder / "meshes" / called, order, swapped).solve(run, called)
                    done = done.again(*words, name="refined")
                    pressure = np.array(done.table("joint")["pressure"])
                    near(f"{called}: nodes in contact", done.pair("joint")["active_nodes"], len(pressure))
                    near(f"{called}: mean pressure", done.pair("joint")["mean_pressure"], lame(), relative=2e-3)
                    near(f"{called}: least and largest pressure", [pressure.min(), pressure.max()], [lame()] * 2, relative=0.06 if order == 2 and "-adapt" in words else 0.01)
    with found.case():  # three in five iterations of the last system are done when a quarter of a factorization is spent
        done = rings(run.folder / "meshes" / "ends", 1, False).solve(run, "ends").again("-adapt", "1e-2", name="refined")
        same("an iteration that is about to end gives way", done.summary["solver"]["gave_way"], False)
    found.end()
