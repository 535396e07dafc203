"""Two half discs: the small one overlaps the end of facets of the large one at another fraction on each mesh. So the number varies. It stays
within a factor of 1.4 (the finest mesh of order 2 in the long run). It is above the number of a node at the limit of its weight (0.07 at order 1,
cut.py)."""
from flatness import numbers
from judge import LONG, require


def judge(run):
    (pair,) = run.summary["pairs"]
    for order, least in (("1", 0.4), ("2", 0.25)):
        betas = numbers(run, pair, 2 if order == "2" and not LONG else 3, "-order", order)
        require(min(betas) > least and max(betas) < 1.4 * min(betas), f"order {order}: {betas}")
