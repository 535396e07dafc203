"""A block one facet wide whose partner goes on beyond its edge. The pressure at a right angle has no limit where the block is no softer than its
partner. Where both are alike it grows by 2^0.226 with each halving of cells (Dundurs and Lee 1972; unit.wedge). On a stiff partner it does not
grow, and nothing is said. At an obtuse angle it grows on any partner (Williams 1952), and with friction it may."""
from judge import LONG, near

OBTUSE = ["-lid_map", "(x+0.5)*(1+0.577*y)-0.5,y"]
# Modulus of the block (that of the partner is 2000), other options; warnings.
EDGE = ["coarse_contact"]
CASES = {"soft": (["-lid_young", "20"], []), "alike": ([], EDGE), "obtuse": (["-lid_young", "20", *OBTUSE], EDGE),
         "rubs": (["-lid_young", "20", "-joint_friction", "0.3"], EDGE), "stiffer": (["-lid_young", "200"], EDGE)}

LEVELS = (4, 5, 6) if LONG else (4, 5)


def judge(run):
    for name, (options, warns) in run.some(CASES.items()):
        run.again(*options, name=name, warns=warns)
    if run.ranks > 1:
        return
    replaced = {6: ["solver_replaced"]}  # multigrid is slow there
    soft, alike = ([run.again(*options, "-dm_refine", f"{level}", name=f"{name}{level}", warns=replaced.get(level, [])).pair("joint")["max_pressure"] for level in LEVELS]
                   for name, options in (("soft", CASES["soft"][0]), ("alike", [])))
    near("pressure of the soft block", soft, [soft[0]] * len(LEVELS), relative=1e-4)
    near("growth of the other", [fine / coarse for coarse, fine in zip(alike, alike[1:])], [2**0.226] * (len(LEVELS) - 1), relative=0.03)
