"""Two rings of options/rings.opts: Lame's thick rings in plane strain."""
import math

from judge import near

BORE, FIT, RIM, OVERLAP = 1.0, 2.0, 3.5, 1e-3  # radii, and by how much the inner ring is too large


def pressure(options):
    def give(body, ratio, sign):
        """Radial displacement of the joint over pressure and radius."""
        young, poisson = float(options[f"{body}_young"]), float(options[f"{body}_poisson"])
        return (1 - poisson**2) / young * (ratio + sign * poisson / (1 - poisson))

    outer = give("outer", (RIM**2 + FIT**2) / (RIM**2 - FIT**2), 1)
    inner = give("inner", (FIT**2 + BORE**2) / (FIT**2 - BORE**2), -1)
    return OVERLAP / (FIT * (outer + inner))


def judge_force(run):
    """The force of a quarter of the joint."""
    near("force over area", run.pair("fit")["normal_force"] / (math.pi / 2 * FIT), pressure(run.summary["options"]), relative=1e-4)


def judge(run):
    """The pressures as well."""
    judge_force(run)
    table = run.table("fit")
    near("pressures", table["pressure"], [pressure(run.summary["options"])] * len(table["x"]), relative=2e-4)
