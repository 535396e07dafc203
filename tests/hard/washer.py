"""Contact along an arc is as narrow as it is, though the box around the arc is wide. The force is that of Almen and Laszlo (1936) without
their factor 1/(1 - nu^2), since no strain across the section is held."""
import math

from judge import near, require, same

E, OUTER, INNER, T, H, S = 206e3, 100, 51, 4, 2.8, 0.05


def judge(run):
    ratio = OUTER / INNER
    k = ((ratio - 1) / ratio) ** 2 / ((ratio + 1) / (ratio - 1) - 2 / math.log(ratio)) / math.pi
    force = 4 * E * T**4 / (k * OUTER**2) * (S / T) * ((H / T) ** 2 + 1)
    for name in ("floor", "lid"):
        pair = run.summary["pairs"][name]
        near("force", 4 * pair["normal_force"], force, relative=0.02)
        require(pair["false_overlap"] < 1e-9, "linear gaps have exact means")
        patch, = pair["patches"]
        require(patch["facets"] < 1, f"{name}: an arc of one facet is said to be {patch['facets']} facets wide")
    warnings = [warning for warning in run.summary["warnings"] if warning["code"] == "coarse_contact"]
    same("told", sorted(warning["pair"] for warning in warnings), ["floor", "lid"])
    for warning, radius in zip(sorted(warnings, key=lambda one: one["pair"]), (OUTER / 2, INNER / 2)):
        require("at an edge" in warning["text"], warning["text"])
        near("a place of the arc", math.hypot(*warning["at"][:2]), radius, relative=1e-6)
