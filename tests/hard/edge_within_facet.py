"""A partner's edge within a facet, and an edge of the nonmortar side: contact begins where bodies touch. Meshes with a node at the edge are the reference."""
from judge import near, same

ALIGNED = ["-block_dm_plex_box_faces", "15,5"]


def energy(run):
    same("additional overlap shows", "false_overlap_at" in run.pair("joint"), False)
    return run.summary["energy"]["potential"]


def judge(run):
    for order in ("1", "2"):
        aligned = energy(run.again(*ALIGNED, "-order", order, name=f"aligned{order}"))
        for slope in ("0.1", "0.9"):
            bent = ["-table_map", f"x, x>7/15 ? y-{slope}*(x-7/15)*(1+y) : y", "-order", order]
            # the mesh of 10 cells ends contact up to a third of a facet too early
            near(f"energy, order {order}, slope {slope}", energy(run.again(*bent, name=f"bent{order}_{slope}")), aligned, relative=0.05)
        own = ["-table_map", "x, x>7/15 ? y-1.5*(x-7/15)*(1+y) : y", "-joint_nonmortar", "table:top", "-joint_mortar", "block:bottom", "-order", order]
        near(f"energy, order {order}, its own edge", energy(run.again(*own, name=f"own{order}")), aligned, relative=0.05)
