"""Scenes put together at random: every number against the independent solver, which computes them on the spot.

Sides are flat or curved, wholly or partly covered. Cells are triangles and quads of order 1, 2 and mixed. Multipliers are at nodes or at
vertices of either side; pairs are contacts and ties. Numbers of the generator are fixed: each test is the same scene at every run.
"""
import random

from compare import RELATIVE, same_tables
from independent import Scene, Solution
from judge import LONG, Run

COUNT = 12  # scenes of one test
CURVED = 1e-6  # where sides are curved or cells stretched, integrals are not exact: 6 Gauss points on a piece, 8 in independent.py
QUARTER = "1.5707963267948966"


def rings(pick, integer):
    """Quarters of two rings with a distance, pressed together; cells are not alike along the joint."""
    inner = pick(["1.9", "1.95", "2"])
    angles = [f"{QUARTER}*{form}" for form in ("y", "(y+0.3*y*(1-y))", "(y-0.2*y*(1-y))")]
    options = {"bodies": "outer,inner", "joint_reach": "1", "joint_gap_offset": repr(float(inner) - 2 - pick([0.002, 0.02, 0.05])),
               "outer_bc_displacement": "right", "outer_bc_displacement_right": pick(["0,0", "-0.02,-0.01"]),
               "inner_bc_displacement": "left", "inner_bc_displacement_left": "0,0", "inner_bc_normal": "bottom,top"}
    for body, lower, upper in (("outer", "2", "3.5"), ("inner", "1", inner)):
        angle = pick(angles)
        options |= {f"{body}_dm_plex_box_faces": f"{integer(1, 2)},{integer(4, 6)}", f"{body}_dm_plex_box_lower": f"{lower},0",
                    f"{body}_dm_plex_box_upper": f"{upper},1", f"{body}_map": f"x*cos({angle}), x*sin({angle})"}
    return options, ["outer:left", "inner:right"]


def plates(pick, integer):
    """One plate on another that is wider, narrower or bent."""
    options = {"bodies": "upper,lower", "joint_reach": "1", "upper_bc_displacement": "top",
               "upper_bc_displacement_top": pick(["0.01,-0.02", "0,-0.01", "0.003,-0.03"]),
               "lower_bc_displacement": "bottom", "lower_bc_displacement_bottom": "0,0",
               "lower_dm_plex_box_lower": pick(["0,-1", "0.13,-1", "-0.2,-1", "0.3501,-1"]),
               "lower_dm_plex_box_upper": pick(["1,0", "0.87,0", "1.2,0", "0.6499,0"]),
               "lower_map": pick(["x, y", "x, y", "x, y-0.1*(x-0.5)^2*(1+y)", "x+0.03*sin(6*x)*(1+y), y-0.15*(x-0.4)^2*(1+y)"]),
               "upper_map": pick(["x, y", "x+0.05*sin(6*x), y", "x, y*(1+0.2*x*(1-x))", "x, y+0.08*(x-0.5)^2*(1-y)"])}
    for body in ("upper", "lower"):
        options[f"{body}_dm_plex_box_faces"] = f"{integer(2, 6)},{integer(1, 4)}"
    if pick([True, False]):
        options |= {"upper_bc_traction": "right", "upper_bc_traction_right": "5,-20", "lower_body_force": "3,-10"}
    return options, ["upper:bottom", "lower:top"]


def options_of(number):
    """A scene as {option: text}."""
    source = random.Random(number)
    pick, integer = source.choice, source.randint
    options, sides = pick([rings, plates, plates])(pick, integer)
    source.shuffle(sides)
    for body in options["bodies"].split(","):
        options |= {f"{body}_dm_plex_simplex": pick("01"), f"{body}_young": pick(["200", "1000", "3000"]),
                    f"{body}_poisson": pick(["0", "0.25", "0.3"]), f"{body}_order": pick("122")}
    options |= {"pairs": "joint", "joint_nonmortar": sides[0], "joint_mortar": sides[1], "model": pick(["plane_strain", "plane_stress"])}
    if options[f"{sides[0].split(':')[0]}_order"] == "2":
        options["joint_multipliers"] = pick(["nodes", "nodes", "vertices"])
    if "joint_gap_offset" not in options:
        options["joint_type"] = pick(["contact", "contact", "contact", "tied"])
    return options


def tolerance_of(options):
    return CURVED if any(name.endswith("_map") and text != "x, y" for name, text in options.items()) else RELATIVE


def judge(run, options_of=options_of, tolerance_of=tolerance_of, every=1):  # pylint: disable=redefined-outer-name
    """[in] options_of - number -> {option: text}; tolerance_of - of such a scene, relative; every - so many of them, one is taken outside
    the long run"""
    first = int(run.arguments[run.arguments.index("-title") + 1].split()[-1])  # "Random scenes from 24"
    for number in range(first, first + COUNT, 1 if LONG else every):
        options = options_of(number)
        path = run.folder / f"scene{number}.opts"
        path.write_text("".join(f'-{name} "{text}"\n' for name, text in options.items()))
        other = Run(run.program, run.mpiexec, run.ranks, run.folder / f"run{number}", ["-options_file", str(path.resolve())])
        other.require_solved()
        scene = Scene(path)
        solution = Solution(scene)
        same_tables(other, solution.nodes(), {pair.name: solution.side(pair) for pair in scene.pairs}, tolerance_of(options))
