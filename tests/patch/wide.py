"""Cut facets at the seam of the two lower bodies: coarse, fine, and slivers down to a thousandth of a facet."""
from uniform import uniform

MESHES = [("3,2", "4,2", "2,2"), ("3,2", "5,2", "3,2"), ("4,3", "7,3", "4,2"), ("5,3", "9,4", "5,3")]
SLIVERS = [0.3, 0.1, 0.01, 0.001]  # of a facet of length 0.2: below 0.045 its outer node loses its multiplier
ROUNDOFF = 1e-13  # of a pressure, divided by the share of its node's support that is covered: a share f of a facet covers f^2 / 2


def tolerance(share):
    return max(1e-12, ROUNDOFF / (share ** 2 / 2)) if share > 0.045 else 1e-12


def judge(run):
    uniform(run, tolerance(0.3))
    for place, (upper, west, east) in run.some(enumerate(MESHES)):
        uniform(run.again("-upper_dm_plex_box_faces", upper, "-west_dm_plex_box_faces", west, "-east_dm_plex_box_faces", east,
                          name=f"mesh{place}"), tolerance(0.15))
    for sliver in run.some(SLIVERS):
        for seam in (0.6 + 0.2 * sliver, 0.6 - 0.2 * sliver):
            uniform(run.again("-west_dm_plex_box_upper", f"{seam:.17g},0", "-east_dm_plex_box_lower", f"{seam:.17g},-1",
                              name=f"seam{seam:.6f}"), tolerance(sliver))
