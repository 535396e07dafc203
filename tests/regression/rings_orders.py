"""X5 with cells of order 2 that follow the circles: orders of displacement, pressure and force against Lame's solution.

A ring a < r < b in plane strain under the pressures p at a and q at b moves by

    u_r = (1 + nu) / (E (b^2 - a^2)) ( (1 - 2 nu) (p a^2 - q b^2) r + (p - q) a^2 b^2 / r ).
"""
import math

from judge import near, require

FIT, RADIUS, HALF_PI = 0.192374956278419, 2.0, 0.5 * math.pi
MESHES = (4, 8)
ENERGY, L2, PRESSURE, FORCE = (2.0, 0.03), (3.0, 0.1), 1.9, 3.8  # expected order and how near; at least
STRESS = 3.5  # at a node within; averages of linear functions alone have 2
MIDDLE = 2.75  # radius of that node, at an eighth of the circle


def motion(young, poisson, a, b, p, q):
    """The expressions of u."""
    factor = (1 + poisson) / young / (b ** 2 - a ** 2)
    linear, inverse = factor * (1 - 2 * poisson) * (p * a ** 2 - q * b ** 2), factor * (p - q) * a ** 2 * b ** 2
    return ", ".join(f"{x}*({linear!r}+({inverse!r})/(x^2+y^2))" for x in "xy")


EXACT = ["-outer_exact_displacement", motion(1000, 0.3, RADIUS, 3.5, FIT, 0), "-inner_exact_displacement",
         motion(3000, 0.25, 1.0, RADIUS, 0, FIT), "-fit_exact_pressure", repr(FIT)]
PROBE = ["-probes", "bore,rim,middle", "-probe_middle_body", "outer", "-probe_middle_at", ",".join(2 * [repr(MIDDLE * math.sqrt(0.5))])]


def errors(run, k):
    faces = ["-outer_dm_plex_box_faces", f"{3 * k},{5 * k}", "-inner_dm_plex_box_faces", f"{2 * k},{4 * k}"]
    again = run.again(*EXACT, *PROBE, *faces, name=f"mesh{k}")
    total, fit = again.summary["errors_total"], again.summary["errors"]["fit"]
    force = again.pair("fit")["normal_force"] / (FIT * RADIUS * HALF_PI) - 1
    mean = FIT * RADIUS ** 2 / (3.5 ** 2 - RADIUS ** 2)  # of the radial and the hoop stress
    xx, _, _, _, _, xy = again.summary["probes"]["middle"]["stress"]
    stress = max(abs(xx - mean), abs(xy + mean * (3.5 / MIDDLE) ** 2))
    return {"energy": total["energy"], "l2": total["l2"], "pressure": fit["pressure_l2"], "force": abs(force), "stress": stress}


def judge(run):
    coarse, fine = (errors(run, k) for k in MESHES)
    order = {name: math.log2(coarse[name] / fine[name]) for name in coarse}
    near("order in the energy norm", order["energy"], ENERGY[0], absolute=ENERGY[1])
    near("order in L2", order["l2"], L2[0], absolute=L2[1])
    require(order["pressure"] >= PRESSURE, f"the pressure is of order {order['pressure']:.3f}")
    require(order["stress"] >= STRESS, f"the stress at a node is of order {order['stress']:.3f}")
    require(order["force"] >= FORCE, f"the force is of order {order['force']:.3f}")
