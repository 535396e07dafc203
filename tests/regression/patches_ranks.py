"""Ranks with one facet each join what touches: the patches of one rank. Two nodes of a facet had kept two labels, and a side of two facets two patches."""
from judge import near, same


def judge(run):
    alone = run.again(ranks=1, name="alone")
    for name, pair in run.summary["pairs"].items():
        mine, other = pair["patches"], alone.pair(name)["patches"]
        same(f"patches of {name}", len(mine), len(other))
        for patch, whole in zip(mine, other):
            for key in ("normal_force", "area", "nodes", "facets"):
                near(f"{key} of {name}", patch[key], whole[key], relative=1e-9)
