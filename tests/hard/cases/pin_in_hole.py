import math

from judge import near, same


def angle(run):
    """Of the last node in contact, from the bottom of the hole."""
    table = run.table("joint")
    return max(math.atan2(abs(x), -y) for x, y, status in zip(table["x"], table["y"], table["status"]) if status == 1)


def persson():
    """Half the angle of contact without play, both bodies alike, by bisection; the integral by Simpson's rule in t = b sin s."""
    def excess(b, cells=400):
        def term(s):
            root, t = math.sqrt(b * b + 1), b * math.sin(s)
            side = b * math.cos(s)
            return math.log((root + side) / (root - side)) / (1 + t * t) * side if side else 0.0

        step = math.pi / cells
        integral = step / 3 * sum((1 if k in (0, cells) else 4 if k % 2 else 2) * term(-math.pi / 2 + k * step) for k in range(cells + 1))
        return 2 * (1 - b * b) - integral / (math.pi * (b * b + 1))

    low, high = 0.1, 1.0
    while high - low > 1e-12:
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) > 0 else (low, middle)
    return 2 * math.atan(low)


def judge(run):
    near("half of the angle", angle(run), persson(), absolute=math.pi / 60)
    table, more = run.table("joint"), run.again("-pin_bc_traction_left", "0,0-30000", name="more").table("joint")
    same("status under a thousand times the load", more["status"], table["status"])
    near("pressures under a thousand times the load", more["pressure"], [1000 * p for p in table["pressure"]], relative=1e-9)
