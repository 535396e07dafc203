"""A hub on a longer shaft, without friction: at its edges the pressure is unbounded by Dundurs and Lee, which the second mesh tells in both roles, and with
any offset of the gap. It does not where the exponent is small (a hub 100 times softer), where the edge is loaded, where both bodies end there, and with
a gap by a formula, which may round the edge."""
from judge import Run, same

SWAPPED = ["-fit_nonmortar", "shaft:right", "-fit_mortar", "hub:left"]
# more arguments, whether the pressure has no limit
CASES = [
    (SWAPPED, True),
    ([], True),
    (["-hub_young", "100"], True),
    (["-hub_young", "10000", *SWAPPED], True),
    (["-fit_gap_offset", "-0.0001"], True),
    (["-hub_young", "10"], False),
    (["-hub_bc_pressure", "top,bottom", "-hub_bc_pressure_top", "0.1", "-hub_bc_pressure_bottom", "0.1"], False),
    (["-shaft_dm_plex_box_lower", "0,-0.5", "-shaft_dm_plex_box_upper", "1,0.5"], False),
    (["-fit_gap", "-0.001+max(0,abs(y)-0.45)^2"], False),
]


def judge(run):
    for case, (more, unbounded) in enumerate(run.some(CASES)):
        solved = Run(run.program, run.mpiexec, run.ranks, run.folder / str(case), run.arguments + more)
        same("exit", solved.exit, 3)  # by the limit
        same(" ".join(more), solved.summary["bars"]["unbounded"], ["fit"] if unbounded else [])
