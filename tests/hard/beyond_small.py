"""Strains that are not small are told, of the body that has the largest: uniform ones, two hundred times those of the patch test."""
import math

from judge import Run, near, require, same

PRESSURE = 2e8  # on Young's moduli 1e9 and 2e9
ACROSS = PRESSURE * (1 - 0.3**2) / 1e9  # 0.182 in the upper block, half of that in the other
ALONG = 0.3 / (1 - 0.3) * ACROSS
NEGLECTED = 0.5 * math.hypot(ACROSS**2, ALONG**2) / math.hypot(ACROSS, ALONG)  # of Green's strain, relative


def judge(run):
    require("small displacements" not in run.stderr, "strains of a thousandth are small")
    found = run.summary["validity"]
    near("neglected strain", found["indicators"]["strain"]["value"], NEGLECTED / 200, relative=1e-9)
    same("colours", {name: indicator["colour"] for name, indicator in found["indicators"].items() if name in ("strain", "rotation", "gap")},
         {"strain": "green", "rotation": "green", "gap": "green"})
    pressed = Run(run.program, run.mpiexec, run.ranks, run.folder / "pressed", run.arguments + ["-upper_bc_displacement_top", f"free,{200 * -1.37875e-3}"])
    pressed.require_solved(["model_limit"])
    strain = pressed.summary["validity"]["indicators"]["strain"]
    near("neglected strain, large", strain["value"], NEGLECTED, relative=1e-9)
    same("colour", strain["colour"], "red")
    require("small displacements are exceeded" in pressed.stderr and "check the units" in pressed.stderr, pressed.stderr)
    require(pressed.summary["validity"]["load_factor"] < 1, "the loads are beyond the theory")
    same("where", pressed.summary["warnings"][0]["body"] if "neglected" in pressed.stderr else "upper", "upper")
