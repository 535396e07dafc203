"""X5 with cells of order 2 that follow the circles: orders of displacement, pressure and force against Lame's solution.

A ring a < r < b in plane strain under the pressures p at a and q at b moves by

    u_r = (1 + nu) / (E (b^2 - a^2)) ( (1 - 2 nu) (p a^2 - q b^2) r + (p - q) a^2 b^2 / r ).
"""
import math

from judge import near, require

FIT, RADIUS, HALF_PI = 0.192374956278419, 2.0, 0.5 * math.pi
MESHES = (4, 8)
ENERGY, L2, PRESSURE, FORCE = (2.0, 0.03), (3.0, 0.1), 1.9, 3.8  # expected order and how near; at least


def motion(young, poisson, a, b, p, q):
    """The expressions of u."""
    factor = (1 + poisson) / young / (b ** 2 - a ** 2)
    linear, inverse = factor * (1 - 2 * poisson) * (p * a ** 2 - q * b ** 2), factor * (p - q) * a ** 2 * b ** 2
    return ", ".join(f"{x}*({linear!r}+({inverse!r})/(x^2+y^2))" for x in "xy")


EXACT = ["-outer_exact_displacement", motion(1000, 0.3, RADIUS, 3.5, FIT, 0), "-inner_exact_displacement",
         motion(3000, 0.25, 1.0, RADIUS, 0, FIT), "-fit_exact_pressure", repr(FIT)]


def errors(run, k):
    faces = ["-outer_dm_plex_box_faces", f"{3 * k},{5 * k}", "-inner_dm_plex_box_faces", f"{2 * k},{4 * k}"]
    again = run.again(*EXACT, *faces, name=f"mesh{k}")
    total, fit = again.summary["errors_total"], again.summary["errors"]["fit"]
    force = again.pair("fit")["normal_force"] / (FIT * RADIUS * HALF_PI) - 1
    return {"energy": total["energy"], "l2": total["l2"], "pressure": fit["pressure_l2"], "force": abs(force)}


def judge(run):
    coarse, fine = (errors(run, k) for k in MESHES)
    order = {name: math.log2(coarse[name] / fine[name]) for name in coarse}
    near("order in the energy norm", order["energy"], ENERGY[0], absolute=ENERGY[1])
    near("order in L2", order["l2"], L2[0], absolute=L2[1])
    require(order["pressure"] >= PRESSURE, f"the pressure is of order {order['pressure']:.3f}")
    require(order["force"] >= FORCE, f"the force is of order {order['force']:.3f}")
