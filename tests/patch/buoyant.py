"""Water pressure and weight: a quadratic displacement to rounding, and balance on bent sides.

sigma = -(5 - 2 z) I gives strains -(1 - 2 nu) / E (5 - 2 z) = (2 z - 5) / 60 in all directions, and the displacement of the scene.
"""
from judge import near

BENT = ["-block_map", "x+0.1*y*(1.2-y)*z, y+0.1*(0.25-x*x)*z, z*(1+0.2*(0.25-x*x)*y*(1.2-y))"]
SIMPLEX = ["-block_dm_plex_simplex", "1"]


def exact(run):
    error = run.summary["errors"]["block"]
    near("error in L2", error["l2_relative"], 0, absolute=1e-12)
    # the strain of a formula comes from differences, which round off to some 1e-12 of the displacement
    near("error of the energy", error["energy_relative"], 0, absolute=1e-11)


def balanced(run):
    """The lower side is flat: water would carry the block there with a pressure of 5 on an area of 1.2."""
    near("reaction", run.summary["reactions"]["block:bottom"], [0, 0, 6], absolute=1e-11)


def judge(run):
    for words in ([], SIMPLEX):
        exact(run.again("-order", "2", *words, name="quadratic"))
        for order in ("1", "2"):
            balanced(run.again("-order", order, *BENT, *words, name="bent"))
