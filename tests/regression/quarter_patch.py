"""Axes of a patch that is a quarter of a circle: by symmetry the longer one is the diagonal between its straight edges."""
import math

from judge import near, require


def judge(run):
    patch, table = run.pair("joint")["patches"][0], run.table("joint")
    half = math.sqrt(0.5)
    near("first axis, its first component positive", patch["axes"][0], [half, -half, 0], absolute=1e-9)
    near("axes across each other", sum(a * b for a, b in zip(*patch["axes"])), 0, absolute=1e-12)
    along = [half * (x - y) for x, y, status in zip(table["x"], table["y"], table["status"]) if status == 1]
    beyond = patch["extent"][0] - (max(along) - min(along))  # each node stands for half of the facets around it
    require(0 <= beyond <= 0.2 * patch["extent"][0], f"extent {patch['extent']}, {beyond} beyond the nodes")
