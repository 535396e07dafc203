"""A block pressed and dragged at once, against its exact dissipation. That of ever smaller steps lies within its bars; that of quarters, and of
dragging alone, are tested too."""
from judge import near, require

SIDE, COEFFICIENT, SLIP = 2, 0.3, 1.4e-3  # pressure is 1 at t = 1


def judge(run):
    growing, dragged = run.summary["steps"]
    exact = SIDE * COEFFICIENT * SLIP / 2
    limit = growing["limit"]
    near("limit", limit["values"]["pairs"]["floor"]["dissipation"], exact, relative=1e-9)
    near("quarters", growing["pairs"]["floor"]["dissipation"], 1.25 * exact, relative=1e-9)
    require(limit["bars"]["pairs"]["floor"]["dissipation"] >= 0.25 * exact, f"bar {limit['bars']['pairs']['floor']['dissipation']}")
    exact = SIDE * COEFFICIENT * 2e-3
    limit = dragged["limit"]
    near("dragged", [dragged["pairs"]["floor"]["dissipation"], limit["values"]["pairs"]["floor"]["dissipation"]], [exact] * 2, relative=1e-9)
    require(limit["bars"]["pairs"]["floor"]["dissipation"] <= 1e-8 * exact, f"bar {limit['bars']['pairs']['floor']['dissipation']}")
