"""A leaf spring that is free to shorten yields to the neglected part of Green's strain, and no indicator warns. Held at both ends, it is strained by it."""
from judge import near, require, same

MODULUS, LENGTH, HEIGHT, DEFLECTION = 210e3 / (1 - 0.3**2), 34, 2, 0.2
FORCE = 3 * MODULUS * HEIGHT**3 / 12 * DEFLECTION / LENGTH**3


def strain(run):
    return run.summary["validity"]["indicators"]["strain"]


def judge(run):
    near("force, of a beam", run.pair("tip")["normal_force"], FORCE, relative=0.01)
    free = strain(run)
    same("colour of a spring that is free to shorten", free["colour"], "green")
    require(free["value"] < 1e-3, f"neglected share of the strain {free['value']:.2e}, below 1e-3")
    slides = run.again("-tip_friction", "0.2", warns=["coarse_contact"], name="slides")
    near("with friction, on a stop where it slides", strain(slides)["value"], free["value"], relative=0.1)
    iterated = run.again("-tip_friction", "0.2", "-pc_type", "truncatedmg", warns=["coarse_contact"], name="slides_iterated")
    near("with friction by multigrid", strain(iterated)["value"], strain(slides)["value"], relative=1e-3)
    sticks = run.again("-tip_friction_bound", "1e6", warns=["coarse_contact", "model_limit"], name="sticks")
    require(strain(sticks)["value"] > 100 * free["value"], f"stuck to the stop: {strain(sticks)['value']:.2e}")
    coarse = run.again("-leaf_dm_plex_box_faces", "18,1", warns=["coarse_contact"], name="coarse")
    near("on a coarser mesh", strain(coarse)["value"], free["value"], absolute=1e-3)
    held = run.again("-leaf_bc_displacement", "left,right", "-leaf_bc_displacement_right", "0,0", "-tip_obstacle_point", "18,11.2",
                     warns=["coarse_contact", "model_limit"], name="held")
    same("colour of one that is held", strain(held)["colour"], "red")
    loose = run.again("-snes_type", "vinewtonrsls", warns=["coarse_contact"], name="other")
    near("by the other solver", strain(loose)["value"], free["value"], relative=1e-3)
    levels = run.again("-pc_type", "truncatedmg", "-dm_refine", "1", warns=["coarse_contact"], name="levels")
    near("by multigrid", strain(levels)["value"], free["value"], absolute=1e-4)
    if run.ranks == 1:
        ranks = run.again(ranks=3, warns=["coarse_contact"], name="ranks")
        near("on three ranks", strain(ranks)["value"], free["value"], relative=1e-3)
