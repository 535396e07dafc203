"""Forces of the legs, at their centres of pressure, balance the loads in height and about both axes. The loads are 1 at (1/2, 1/2) and 1/4 at
(2/3, 2/3)."""
from legs import judge_legs as judge  # noqa: F401  pylint: disable=unused-import
