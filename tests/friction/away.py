"""Where all slips away from a plane of symmetry, friction is mu N. The node on the plane has none, by symmetry, and so its part of the side is missing. Meshes
agree on the sum until facets there are refined: the bar knows what is missing."""
from judge import near, require


def judge(run):
    pair, bars = run.pair("joint"), run.summary["bars"]["pairs"]["joint"]
    whole = 0.05 * pair["normal_force"]
    for number in ("tangential_force", "force"):
        near(number, pair[number][0], whole, absolute=bars[number][0])
    require(bars["tangential_force"][0] < 0.1 * whole, f"the bar {bars['tangential_force'][0]} says nothing")
    require(pair["slip_share"] > 0.9, f"it does not slip: {pair['slip_share']}")
