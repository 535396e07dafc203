"""Refinements that all bodies of files have by their own options make levels: the mesh and the answer of -dm_refine, and hardly more
iterations than on the levels of boxes. Levels of nodes took 20 for the same system."""
from judge import near, require

ITERATIONS = 13
OWN = ["-wheel_dm_refine", "1", "-rail_dm_refine", "1"]


def judge(run):
    levels = run.again("-dm_refine", "1", name="levels")
    for ranks in (1, 3):
        own = run.again(*OWN, ranks=ranks, name=f"own{ranks}")
        needed = own.summary["solver"]["linear_reference"]["iterations"]
        require(needed <= ITERATIONS, f"{needed} iterations of one system on {ranks} ranks")
        near("largest pressure", own.pair("contact")["max_pressure"], levels.pair("contact")["max_pressure"], relative=1e-6)
        near("force", own.pair("contact")["force"], levels.pair("contact")["force"], relative=1e-9)
