"""Quadratic facets cut at the seam of the two lower bodies, on quadratic and linear ones, down to slivers."""
from uniform import uniform

# of a facet of length 0.2: up to 3/4 its outer node loses its multiplier, below 0.13 the middle one, too
COVERED = [0.75, 0.3, 0.14, 0.01, 1e-6]
TOLERANCE = 1e-11  # the middle node's share of its facet is 3 f^2, of which roundoff is the greater part the smaller it is


def judge(run):
    for orders in ([], ["-west_order", "1", "-east_order", "1"]):
        for share in COVERED:
            for seam in (0.6 + 0.2 * share, 0.6 - 0.2 * share):
                uniform(run.again(*orders, "-west_dm_plex_box_upper", f"{seam:.17g},0", "-east_dm_plex_box_lower", f"{seam:.17g},-1",
                                  name=f"seam{seam:.7f}"), TOLERANCE)
