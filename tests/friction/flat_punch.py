"""A flat rigid punch that is pressed on: its middle sticks. c/a by an independent program (collocation on the half plane). In the slip zone the slip grows like
(x - c)^(3/2) from its edge on, which gives c between nodes."""
from judge import LONG, near, require

CASES = ((0.3, 0.2, 0.36038), (0.3, 0.3, 0.68909), (0, 0.25, 0.0991), (0, 0.5, 0.52191))  # Poisson's ratio, coefficient, c/a


def edge(table):
    """Where slip begins: (x, slip^(2/3)) of the second to fourth node that slips, on their line of least squares."""
    rows = sorted((x, abs(s)) for x, s, status in zip(table["x"], table["slip_x"], table["status"]) if status == 3)[1:4]
    points = [(x, s ** (2 / 3)) for x, s in rows]
    x0, y0 = (sum(values) / 3 for values in zip(*points))
    return x0 - y0 * sum((x - x0) ** 2 for x, _ in points) / sum((x - x0) * (y - y0) for x, y in points)


def judge(run):
    for poisson, coefficient, expected in CASES if LONG else CASES[::3]:
        delivered = (poisson, coefficient) == CASES[0][:2]
        done = run if delivered else run.again("-block_poisson", str(poisson), "-punch_friction", str(coefficient), name=f"p{poisson}_{coefficient}")
        table = done.table("punch")
        found = edge(table)
        near(f"c/a, nu {poisson}, mu {coefficient}", found, expected, relative=0.01)
        stuck = max(x for x, status in zip(table["x"], table["status"]) if status == 4)
        slips = min(x for x, status in zip(table["x"], table["status"]) if status == 3)
        require(stuck < slips and all((status == 4) == (x <= stuck) for x, status in zip(table["x"], table["status"]) if status > 2), "the sticking zone has holes")
        require(done.summary["solver"]["iterations"] <= 16, f"{done.summary['solver']['iterations']} Newton steps")
