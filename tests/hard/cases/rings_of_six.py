"""All blocks are under the same pressure, and both circles are broken where reasons are weakest."""
from ring_of_three import judge_ring


def judge(run):
    judge_ring(run, {"ab": "a", "bc": "c", "be": "b", "ad": "d", "cf": "f", "fe": "f", "ed": "d"})
