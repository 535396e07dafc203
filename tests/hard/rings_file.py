"""Sides of a file of first order that are taken for smooth: Lame's pressure .192374956 between two thick rings, from a closed formula.

In a ring with the stresses A - B/r^2 and A + B/r^2 the displacement is (1 + nu)/E ((1 - 2 nu) A + B/r^2) times the position."""
import math

from judge import near, require

from lame import BORE, FIT, OVERLAP, RIM, pressure

MEAN = [0.2, 0.02, 0.002, 3e-4]  # of the force, by refinement: the last three fall by 5 at least
NODES = [0.25, 0.025, 0.005, 1e-3]


def errors(run):
    """Of the force over the area of the joint, and the largest of a node, as parts of the pressure."""
    exact = pressure(run.summary["options"])
    mean = run.pair("fit")["normal_force"] / (math.pi / 2 * FIT) / exact - 1
    table = run.table("fit")
    for x, y in zip(table["x"], table["y"]):
        near("radius of a node of the joint", math.hypot(x, y), FIT, relative=1e-14)
    return abs(mean), max(abs(p / exact - 1) for p in table["pressure"])


def judge_options(options):
    """The displacements that bore and rim are given are those of the closed formula."""
    p = pressure(options)
    inner, outer = -p * FIT**2 / (FIT**2 - BORE**2), p * FIT**2 / (RIM**2 - FIT**2)
    near("overlap", float(options["fit_gap_offset"]), -OVERLAP)
    for body, side, a, b in (("inner", "bore", inner, inner * BORE**2), ("outer", "rim", outer, outer * RIM**2)):
        text, nu = options[f"{body}_bc_displacement_{side}"], float(options[f"{body}_poisson"])
        for number in ((1 + nu) / float(options[f"{body}_young"]), (1 - 2 * nu) * a, b):
            require(f"{number:.12e}"[:12] in text, f"the displacement of the {side} does not have {number:.12e}")


def judge(run):
    judge_options(run.summary["options"])
    found = [errors(run)] + [errors(run.again("-dm_refine", str(level), warns=())) for level in range(1, 4)]
    for level, (mean, node) in enumerate(found):
        require(mean < MEAN[level] and node < NODES[level], f"refined {level} times: mean off by {mean:.3g}, a node by {node:.3g}")
    for coarse, fine in zip(found, found[1:]):
        require(fine[0] < coarse[0] / 4, f"the mean is off by {coarse[0]:.3g}, and by {fine[0]:.3g} on a mesh twice as fine: order 2 is 4 times less")

    # bodies that are refined one by one, before they are merged, come to the same
    alone = run.again("-inner_dm_refine", "1", "-outer_dm_refine", "1", warns=())
    near("force of bodies refined alone", alone.pair("fit")["normal_force"], run.again("-dm_refine", "1", warns=()).pair("fit")["normal_force"], relative=1e-10)

    # cells of order 2: their middle nodes are on the curves as well
    found = [errors(run.again("-order", "2", "-dm_refine", str(level), warns=())) for level in (1, 2)]
    require(found[0][0] < 2e-5 and found[1][0] < found[0][0] / 4, f"order 2: the mean is off by {found[0][0]:.3g} and {found[1][0]:.3g}")

    # polygons stay what they are: new nodes lie in the middles of their sides
    table = run.again("-dm_refine", "1", "-inner_polygonal", "1", "-outer_polygonal", "1", warns=["coarse_contact", "coarse_curve", "model_limit"]).table("fit")
    radii = sorted(math.hypot(x, y) for x, y in zip(table["x"], table["y"]))
    near("radii of polygons", radii, [FIT * math.cos(math.pi / 16)] * 4 + [FIT] * 5, relative=1e-14)
