"""A block one facet wide whose partner goes on beyond its edge: the pressure at a right angle has no limit where the block is no softer than its
partner, and grows by 2^0.226 with each halving of cells where both are alike (Dundurs and Lee 1972; unit.wedge). On a stiff partner it does
not grow, and nothing is said; at an obtuse angle it grows on any partner (Williams 1952), and with friction it may."""
from judge import near, require

OBTUSE = ["-lid_map", "(x+0.5)*(1+0.577*y)-0.5,y"]
# Modulus of the block (that of the partner is 2000), other options; warnings.
EDGE = ["coarse_contact"]
CASES = {"soft": (["-lid_young", "20"], []), "alike": ([], EDGE), "obtuse": (["-lid_young", "20", *OBTUSE], EDGE),
         "rubs": (["-lid_young", "20", "-joint_friction", "0.3"], EDGE + ["held_friction"]), "stiffer": (["-lid_young", "200"], EDGE)}


def judge(run):
    for name, (options, warns) in run.some(CASES.items()):
        run.again(*options, name=name, warns=warns)
    if run.ranks > 1:
        return
    soft, alike = ([run.again(*options, "-dm_refine", f"{level}", name=f"{name}{level}", warns=[]).pair("joint")["max_pressure"] for level in (4, 5, 6)]
                   for name, options in (("soft", CASES["soft"][0]), ("alike", [])))
    near("pressure of the soft block", soft, [soft[0]] * 3, relative=1e-4)
    near("growth of the other", [alike[1] / alike[0], alike[2] / alike[1]], [2**0.226] * 2, relative=0.03)
    require(alike[2] > 1.3 * alike[0], alike)
