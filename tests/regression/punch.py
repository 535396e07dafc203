"""R4a: a rigid flat punch; singular at its edges, so that force and inner pressures are compared."""
from judge import near


def at(table, x):
    """Pressure at x by linear interpolation along the side."""
    points = sorted(zip(table["x"], table["pressure"]))
    for (a, p), (b, q) in zip(points, points[1:]):
        if a <= x <= b:
            return p + (q - p) * (x - a) / (b - a)
    raise ValueError(x)


def judge(run):
    near("force", run.pair("punch")["normal_force"], 10.52784, relative=5e-3)
    near("p(0)", at(run.table("punch"), 0.0), 7.00958, relative=5e-3)
    near("p(.25)", at(run.table("punch"), 0.25), 7.9126, relative=5e-3)
    near("u_y beside", run.probe("beside")["displacement"][1], -0.0028512, relative=1e-2)
