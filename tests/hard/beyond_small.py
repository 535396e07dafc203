"""Strains that are not small are told, of the body that has the largest: uniform ones, two hundred times those of the patch test."""
from judge import Run, require

PRESSURE = 2e8  # on Young's moduli 1e9 and 2e9
STRAIN = PRESSURE * (1 - 0.3**2) / 1e9  # 0.182 in the upper block, 0.094 in the other


def judge(run):
    require("small strains are exceeded" not in run.stderr, "strains of a thousandth are small")
    pressed = Run(run.program, run.mpiexec, run.ranks, run.folder / "pressed", run.arguments + ["-upper_bc_displacement_top", f"free,{200 * -1.37875e-3}"])
    pressed.require_solved("model_limit")
    require(f"small strains are exceeded: body upper is strained or rotated by up to {STRAIN:.3g};" in pressed.stderr, pressed.stderr)
    require(pressed.summary["warnings"][0]["body"] == "upper", str(pressed.summary["warnings"]))
