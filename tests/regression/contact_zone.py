"""The claims of options/CONTACT_ZONE.md on meshes and corners: the error counts facets in the zone. A narrower side leaves the inf-sup number
as it is. The pressure at a sharp edge grows with refinement without end, that of a rounded edge does not."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "options" / "studies"))
from closedforms import line, rounded, rounded_pressure  # pylint: disable=wrong-import-position
from judge import LONG, near, require

MODULUS, R = 1000 / 0.91 / 2, 1000


def errors(run, depth):
    """(facets in the half width, order, error) of meshes of 8 to 64 facets, against the finest of order 2."""
    study = run.again("-upper_dm_plex_box_faces", "8,8", "-lower_dm_plex_box_faces", "6,6", "-upper_bc_displacement_top", f"free,{-depth!r}",
                      "-study", "uniform", "-study_levels", "4", "-study_orders", "1,2", name=f"depth{depth}").summary["study"]["runs"]
    a = line(2 * study[-1]["joint_normal_force"], R, MODULUS)[0]
    return [(a * 8 * 2**r["level"], r["order"], r["energy_error_relative"]) for r in study[:-2]]


def judge(run):
    found = errors(run, 0.000033) + (errors(run, 0.00011) if LONG else [])  # zones of 0.155 and of 0.33
    for facets, order, error in found:
        if facets > 1:  # order 1: 0.37 h/a, order 2: 0.12 (h/a)^1.5, with a factor that depends little on the zone
            require(1 / 1.4 < error * facets / 0.37 < 1.4 if order == 1 else 1 / 1.6 < error * facets**1.5 / 0.12 < 1.6,
                    f"order {order}, {facets:.3g} facets: error {error:.4g}")
    betas = []
    for facets in (64, 16, 4):
        side = run.again("-upper_dm_plex_box_faces", f"{facets},64", "-upper_dm_plex_box_upper", f"{facets / 64},1", "-joint_gap", "0", "-infsup",
                         name=f"side{facets}").pair("joint")["inf_sup"]
        betas.append(side["number"])
        require(side["condition"] < 110, f"condition number {side['condition']}")
    near("inf-sup numbers of narrower sides", betas, [betas[0]] * 3, relative=0.01)

    def pad(gap, level):
        other = run.again("-joint_gap", gap, "-upper_bc_displacement_top", "free,-0.00003", "-dm_refine", str(level), name=f"pad{level}_{len(gap)}")
        return 2 * other.pair("joint")["normal_force"], other.pair("joint")["max_pressure"]

    (_, coarse), (_, fine) = (pad("x<0.125 ? 0 : 0.001", level) for level in (0, 1))
    near("growth at a sharp edge", fine / coarse, math.sqrt(2), relative=0.03)
    F, found = pad("max(0,x-0.125)^2/100", 1)
    half = rounded(F, 0.125, 50, MODULUS)
    exact = max(rounded_pressure([0.12 + 0.0005 * k for k in range(40)], half, 0.125, 50, MODULUS))
    near("largest pressure of a rounded pad", found, exact, relative=0.02)
