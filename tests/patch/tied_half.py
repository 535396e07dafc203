"""Half a model with a plane of symmetry has the solution of the whole: a tied node on that plane is tied along it (eq. 5.5)."""
from judge import near

HALF = ["-upper_dm_plex_box_faces", "5,5", "-lower_dm_plex_box_faces", "7,7", "-upper_dm_plex_box_lower", "0,0", "-lower_dm_plex_box_lower", "0,-1",
        "-upper_bc_normal", "left", "-lower_bc_normal", "left"]
SWAPPED = ["-tie_nonmortar", "upper:bottom", "-tie_mortar", "lower:top"]
# Exact where no nonmortar facet at the plane is longer than the mortar one; without the rows of the plane's node, 9e-7 and 2.9e-6.
CASES = {"finer": ([], 1e-12), "finer_2": (["-order", "2"], 1e-12), "coarser": (SWAPPED, 1e-6), "multigrid": (["-pc_type", "truncatedmg"], 1e-9)}


def judge(run):
    for name, (options, relative) in run.some(CASES.items()):
        whole = run.again(*options, name=f"whole_{name}").summary["energy"]["potential"]
        half = run.again(*options, *HALF, name=f"half_{name}")
        near(f"potential of both halves, {name}", 2 * half.summary["energy"]["potential"], whole, relative=relative)
        near(f"force of half, {name}", half.pair("tie")["force"][1], (1 if options == SWAPPED else -1) * 2 / 3, relative=1e-9)
