"""A load along a direction that a support of the same side fixes. It is solved as if that load were not there. A warning names body,
direction and lost force. Forces are products of stress, length and thickness, by hand."""
import math
import re

from judge import near, require, same

NUMBER = r"[-+0-9.e]+"
# By the scene: options, the words of the direction, the lost force, options that are the same without that load.
CASES = {
    "block": [
        ("-block_bc_normal left -block_bc_force left -block_bc_force_left 3,4", "its normal", [3, 0], "-block_bc_normal left -block_bc_force left -block_bc_force_left 0,4"),
        ("-block_bc_normal left -block_bc_traction left -block_bc_traction_left 3,4", "its normal", [1.5, 0],
         "-block_bc_normal left -block_bc_traction left -block_bc_traction_left 0,4"),
        ("-block_bc_normal left -block_bc_pressure left -block_bc_pressure_left 2", "its normal", [1, 0], "-block_bc_normal left"),
        ("-block_bc_displacement bottom,top -block_bc_displacement_top free,0 -block_bc_traction top -block_bc_traction_top 1,2", "y", [0, 2],
         "-block_bc_displacement bottom,top -block_bc_displacement_top free,0 -block_bc_traction top -block_bc_traction_top 1,0"),
        ("-block_bc_displacement bottom,top -block_bc_displacement_top 0,0 -block_bc_traction top -block_bc_traction_top x,0", "x, y", [1, 0],
         "-block_bc_displacement bottom,top -block_bc_displacement_top 0,0"),
        ("-block_bc_normal left -block_bc_traction left+top -block_bc_traction_left+top 3,4", "its normal", [1.5, 0], None)],
    "ring": [
        ("-block_bc_pressure bottom -block_bc_pressure_bottom 1", "r, z", [0, 8 * math.pi], ""),
        ("-block_bc_displacement bottom,top -block_bc_displacement_top free,0 -block_bc_traction top -block_bc_traction_top 0,2", "z", [0, 16 * math.pi],
         "-block_bc_displacement bottom,top -block_bc_displacement_top free,0")],
    "brick": [
        ("-block_bc_normal left,right -block_bc_pressure left -block_bc_pressure_left 3", "its normal", [3, 0, 0], "-block_bc_normal left,right"),
        ("-block_bc_displacement bottom,right -block_bc_displacement_right free,0,free -block_bc_traction right -block_bc_traction_right 1,2,3", "y",
         [0, 2, 0], "-block_bc_displacement bottom,right -block_bc_displacement_right free,0,free -block_bc_traction right -block_bc_traction_right 1,0,3")],
}
SILENT = {
    "block": ("-block_bc_normal left -block_bc_traction left -block_bc_traction_left 0,4",
              "-block_bc_displacement bottom,top -block_bc_displacement_top free,0 -block_bc_traction top -block_bc_traction_top 1,0",
              "-block_bc_normal left -block_bc_traction top -block_bc_traction_top 3,4"),
    "ring": ("-block_bc_pressure top -block_bc_pressure_top 1",),
    "brick": ("-block_bc_normal left,right -block_bc_pressure top -block_bc_pressure_top 3",),
}


def judge(run):
    scene = next(name for name in CASES if run.arguments[1].endswith(f"{name}.opts"))
    for number, (options, direction, force, without) in run.some(enumerate(CASES[scene])):
        case = run.again(*options.split(), name=f"case{number}", warns=["lost_traction"])
        warning = case.summary["warnings"][0]
        told = re.search(rf"acts along (.*), which (\S+).* fixes: a force of \(({NUMBER}(?:, {NUMBER})*)\)", warning["text"])
        require(told, f"no force in {warning}")
        same(f"{options}: direction", told.group(1), direction)
        same(f"{options}: body", warning["body"], "block")
        near(f"{options}: lost force", [float(word) for word in told.group(3).split(",")], force, relative=1e-5)
        if without is not None:
            other = run.again(*without.split(), name=f"without{number}", warns=[])
            near(f"{options}: strain energy", case.summary["energy"]["strain"]["block"], other.summary["energy"]["strain"]["block"], relative=1e-9)
    for number, options in run.some(enumerate(SILENT[scene])):
        run.again(*options.split(), name=f"silent{number}", warns=[])
