"""Which side is nonmortar is no matter of physics: forces and largest pressures agree to 0.1 %.

Half discs, crossed cylinders and, as rings about one axis and in space, two spheres of stiffness 100 : 1.
"""
import pathlib

from judge import LONG
from scenes import Findings, Run, Scene, require

OPTIONS = pathlib.Path(__file__).resolve().parents[2] / "options"


def spheres(swapped, order, cells):
    """Quarters of two balls about the z axis, the upper one 100 times as stiff. Cells at the edge of contact are a fifth of its radius wide (order 2)."""
    scene = Scene(dim=3, order=order)
    fine = [f"(0.2*{c}+0.8*{c}^9)" for c in "xy"]
    for name, young, sign, n in (("stiff", 1e5, 1, cells), ("soft", 1e3, -1, cells + 1)):
        # a block of the ball around its pole: [0, 0.7]^2 seen from the centre, between radii 0.5 and 1
        r = "(1-0.5*(0.2*z+0.8*z^2))"
        pole = f"sqrt(1+(0.7*{fine[0]})^2+(0.7*{fine[1]})^2)"
        across = [f"{r}*0.7*{f}/{pole}" for f in fine]
        scene.block(name, (n, n, n // 2 + 1), (0, 0, 0), (1, 1, 1), young=young, map=f"{across[0]}, {across[1]}, {sign}*(1-{r}/{pole})",
                    bc_normal="left,front", bc_displacement="top", bc_displacement_top=f"0,0,{-0.01 if sign > 0 else 0}")
    scene.joint("joint", "stiff:bottom", "soft:bottom", swapped=swapped)
    return scene


def judge_swapped(what, one, other, pair):
    for figure in ("normal_force", "max_pressure"):
        a, b = one.pair(pair)[figure], other.pair(pair)[figure]
        require(abs(a - b) <= 1e-3 * abs(a), f"{what}: {figure} is {a:.6g} and, roles swapped, {b:.6g}: {abs(a - b) / abs(a):.3g} of it ({one.folder}, {other.folder})")


def shipped(run, scene, pair, sides, *more):
    """A scene of options/ with its roles as they are and swapped."""
    both = []
    for name, (nonmortar, mortar) in (("as_shipped", sides), ("swapped", sides[::-1])):
        arguments = ["-options_file", str(OPTIONS / f"{scene}.opts"), f"-{pair}_nonmortar", nonmortar, f"-{pair}_mortar", mortar, *more]
        both.append(Run(run.program, run.mpiexec, 1, run.folder / f"{scene}_{name}", arguments))
        require(both[-1].exit == 0, f"{scene} {name}: exit code {both[-1].exit}")
    judge_swapped(scene, *both, pair)


def judge(run):
    found = Findings()
    with found.case():
        shipped(run, "half_discs", "joint", ("upper:upper_arc", "lower:lower_arc"))
    if LONG:
        with found.case():
            shipped(run, "crossed_cylinders", "cross", ("upper:bottom", "lower:top"))
        for order, cells in ((1, 20), (2, 12)):
            with found.case():
                judge_swapped(f"spheres_{order}", *(spheres(swapped, order, cells).solve(run, f"spheres_{order}_{swapped}") for swapped in (False, True)), "joint")
    found.end()
