"""Cut facets at the seam of the two lower bodies, down to slivers that lose their multipliers."""
from solid import TOLERANCE, TURN, column, turned

SLIVERS = [0.3, 0.1, 0.01, 0.001]  # of a facet of length 0.25
ROUNDOFF = 1e-12  # of a pressure, divided by the share of its node's support that is covered: f of a facet covers f^2 / 2


def judge(run):
    quadratic = any(word.endswith("order") for word in run.arguments)
    column(turned(run, name="turned"), turn=TURN)
    for sliver in run.some(SLIVERS):
        seam = 0.5 + 0.25 * sliver
        tolerance = TOLERANCE if quadratic or sliver < 0.05 else ROUNDOFF / (sliver ** 2 / 2)
        column(run.again("-west_dm_plex_box_upper", f"{seam:.17g},1,0", "-east_dm_plex_box_lower", f"{seam:.17g},0,-0.5",
                         name=f"seam{seam:.6f}"), tolerance)
