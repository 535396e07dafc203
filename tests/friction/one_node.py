"""One triangle with one free node on a rigid floor. Its 2 x 2 stiffness is known. Statuses open, stick and both slips are tried one by one: with mu |k_tn| < k_tt exactly
one fits for every force; the program finds it, and rho = mu |k_tn| / k_tt where the node slips. Beyond, rho > 1 and some forces have three solutions. At the one that
slips and is the only one the eigenvalue is -rho, at the one that slips and has two others it is rho: the program tells these."""
import itertools
import math
import random

from judge import Run, near, require

YOUNG, POISSON = 1000.0, 0.3


def stiffness(x, y):
    """Of the free node at the origin in the triangle (0,0), (1,0), (x,y) of plane stress and thickness 1: [[k_xx, k_xy], [k_xy, k_yy]]."""
    area = y / 2
    b, c = (0 - y) / (2 * area), (x - 1) / (2 * area)  # the derivatives of its shape function
    factor = YOUNG / (1 - POISSON**2)
    shear = (1 - POISSON) / 2
    return [[area * factor * (b * b + shear * c * c), area * factor * (POISSON + shear) * b * c],
            [area * factor * (POISSON + shear) * b * c, area * factor * (c * c + shear * b * b)]]


def solutions(k, mu, force):
    """[(status, u_x, p, q)] of all statuses that fit a force on the free node, for p >= 0 upwards and q along x."""
    (kxx, kxy), (_, kyy) = k
    fx, fy = force
    found = []
    det = kxx * kyy - kxy * kxy
    ux, uy = (kyy * fx - kxy * fy) / det, (kxx * fy - kxy * fx) / det
    if uy > 0:
        found.append((0, ux, 0.0, 0.0))
    if -fy > 0 and abs(fx) <= mu * -fy:
        found.append((4, 0.0, -fy, -fx))
    for sign in (1, -1):  # q = -sign mu p, slip along sign:  k_xx u = fx - sign mu p,  p = k_xy u - fy
        u = (fx + sign * mu * fy) / (kxx + sign * mu * kxy)
        p = kxy * u - fy
        if p > 0 and sign * u > 0:
            found.append((3, u, p, -sign * mu * p))
    return found


MESH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
1 1 "floor"
1 2 "held"
1 3 "loaded"
2 4 "all"
$EndPhysicalNames
$Nodes
3
1 0 0 0
2 1 0 0
3 {x} {y} 0
$EndNodes
$Elements
4
1 1 2 1 1 1 2
2 1 2 2 2 2 3
3 1 2 3 3 3 1
4 2 2 4 4 1 2 3
$EndElements
"""


def solve(run, name, x, y, mu, force):
    folder = run.folder / name
    mesh = run.folder / f"{name}.msh"
    mesh.write_text(MESH.format(x=x, y=y))
    area = y / 2
    options = ["-model", "plane_stress", "-bodies", "block", "-block_dm_plex_filename", str(mesh), "-block_young", str(YOUNG), "-block_poisson", str(POISSON), "-block_bc_displacement", "held",
               "-block_bc_displacement_held", "0,0", "-block_body_force", f"{3 * force[0] / area!r},{3 * force[1] / area!r}", "-pairs", "floor", "-floor_nonmortar", "block:floor",
               "-floor_obstacle", "plane", "-floor_obstacle_normal", "0,1", "-floor_friction", repr(mu)]
    return Run(run.program, run.mpiexec, run.ranks, folder, options)


def judge(run):
    random.seed(19)
    kinds, beyond, several = set(), 0, 0
    for case, (x, y) in itertools.product(range(12), ((-1.5, 0.8), (0.3, 1.2))):
        k = stiffness(x, y)
        limit = k[0][0] / abs(k[0][1])
        mu = limit * (random.uniform(0.1, 0.95) if case % 2 else random.uniform(1.05, 3))
        force = [random.gauss(0, 1e-4), random.gauss(-1e-4, 1e-4)]
        if case % 4 == 0:  # three solutions: pressed by slip alone
            force = next(f for f in ([random.gauss(0, 1e-4), -abs(random.gauss(0, 1e-5))] for _ in range(1000)) if len(solutions(k, mu, f)) > 1)
        if case % 4 == 2:  # pushed hard towards the side on which slip presses: it slips, beyond the limit, too
            force[0] = math.copysign(4 * mu * abs(force[1]), k[0][1])
        all_of = solutions(k, mu, force)
        if mu < limit:
            require(len(all_of) == 1, f"{len(all_of)} solutions for mu {mu} < {limit}")
        done = solve(run, f"case{case}_{x}", x, y, mu, force)
        require(done.exit == 0, f"exit {done.exit}: {done.stderr} {all_of}")
        table, friction = done.table("floor"), done.summary["solver"]["friction"]
        row = min(range(len(table["x"])), key=lambda r: abs(table["x"][r]))
        fits = [s for s in all_of if s[0] == table["status"][row]]
        scale = max(map(abs, force))
        # The slip at the node is the mean over the facet, whose other end is held: the row of that end is part of this one.
        near("slip", min((abs(s[1] / 2 - table["slip_x"][row]) for s in fits), default=1) if table["status"][row] else 0, 0, absolute=1e-7 * scale)
        require(fits, f"status {table['status'][row]}, possible {all_of}")
        kinds.add(fits[0][0])
        several += len(all_of) > 1
        if table["status"][row] == 3:
            near("rho", friction["rho"], mu / limit, relative=1e-6)
            beyond += mu > limit
            require(friction["unique"] == (mu < limit) and friction["others"] == (len(all_of) > 1), f"{friction}, {len(all_of)} solutions")
    require(kinds == {0, 3, 4} and several >= 4 and beyond, f"statuses {kinds}, {several} with several solutions, {beyond} beyond the limit that slip")
