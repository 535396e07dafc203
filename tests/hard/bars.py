"""Two bars of bars.opts: springs in a row, M = E (1 - nu) / ((1 + nu) (1 - 2 nu)) and the height of each. What is beyond the gap presses."""
from judge import near, same

ROUNDING = 1e-10  # relative, of a uniform state


def bar(options, body):
    """Stiffness per area, lower and upper end, width."""
    young, poisson = float(options[f"{body}_young"]), float(options[f"{body}_poisson"])
    bottom, top = (float(options[f"{body}_dm_plex_box_{end}"].split(",")[1]) for end in ("lower", "upper"))
    width = float(options[f"{body}_dm_plex_box_upper"].split(",")[0])
    return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)) / (top - bottom), bottom, top, width


def expected(options):
    """Pressure, and gap after loading; stiffness of both per area; width."""
    upper, lower = bar(options, "upper"), bar(options, "lower")
    gap = float(options.get("joint_gap", upper[1] - lower[2])) + float(options.get("joint_gap_offset", 0))
    overlap = -float(options["upper_bc_displacement_top"].split(",")[1]) - gap
    return (overlap / (1 / upper[0] + 1 / lower[0]), 0.0) if overlap > 0 else (0.0, -overlap), upper[0], lower[0], upper[3]


def judge(run, relative=ROUNDING):
    options, table = run.summary["options"], run.table("joint")
    (pressure, gap), upper, lower, width = expected(options)
    count, nothing = len(table["pressure"]), 0 if pressure else 1e-12 * float(options["upper_young"])  # of stress, where there is none
    near("pressure", table["pressure"], [pressure] * count, relative=relative, absolute=nothing)
    near("gap", table["gap"], [gap] * count, relative=relative, absolute=1e-12 * (1 + pressure / upper))
    same("nodes in contact", run.pair("joint")["active_nodes"], count if pressure else 0)
    near("force", run.pair("joint")["force"], [0, pressure * width], relative=relative, absolute=nothing)
    strain = run.summary["energy"]["strain"]
    near("energies", [strain["upper"], strain["lower"]], [width * pressure**2 / stiffness / 2 for stiffness in (upper, lower)],
         relative=2 * relative, absolute=1e-20 * upper)
