"""The mean gap beside a bend within a facet is below all gaps there. Where that is much it is not taken; where it is little, it is told with
its size; and where a facet ends at the bend there is nothing of it."""
from judge import near, require

FACET, SLOPE, SLIGHT, BEND = 0.2, 0.5, 0.05, 1 / 3  # the bend is a third into the facet from 0.4 to 0.6
FALLS = "x, x>7/15 ? y-{}*(x-7/15)*(1+y) : y"
TOLD = "not to be trusted near (0.4, 0): the gap has a step or a bend within a facet there, and its mean pushes as if bodies overlapped by "


def antiderivative(t):
    """Of psi (t - BEND), psi = 2 - 3 t the dual function of the node at t = 0, which has int psi = 1/2 on each of its two facets."""
    return -(t**3) + (2 + 3 * BEND) / 2 * t**2 - 2 * BEND * t


def require_silent(run):
    pair = run.pair("joint")
    require(pair["false_overlap"] < 1e-12 and "false_overlap_at" not in pair and "not to be trusted" not in run.stdout, run.stdout)
    near("force", pair["normal_force"], 2, relative=1e-9)


def judge(run):
    require_silent(run)
    ends = run.again("-block_dm_plex_box_faces", "15,5", name="ends")  # of facets, at the bend
    require_silent(ends)
    # both press on what is level, 1 + 7 / 15 long, and a little beyond; with the mean gap it was 0.9, and 8 % more in energy
    near("area", run.pair("joint")["area"], ends.pair("joint")["area"], absolute=FACET / 2)
    for size in ("30,15", "40,20"):
        require_silent(run.again("-block_dm_plex_box_faces", size, name=size))
    slight = run.again("-table_map", FALLS.format(SLIGHT), name="slight")
    overlap = -SLIGHT * FACET * (antiderivative(1) - antiderivative(BEND))  # all gaps there are at least 0
    near("overlap", slight.pair("joint")["false_overlap"], overlap, relative=1e-9)
    near("its place", slight.pair("joint")["false_overlap_at"], [0.4, 0], absolute=1e-12)
    require(f"{TOLD}{overlap:.3g} more" in slight.stdout, slight.stdout)
