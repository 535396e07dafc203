"""Friction with a history, against a program of this test: bilinear cells are assembled and condensed to the nodes on a rigid floor, and nonlinear Gauss-Seidel solves each load step.
On a floor the dual multiplier of a node is the force of that node, and a bound acts on the integral of its shape function. Coefficients and bounds vary with place and time."""
import itertools
import math

import numpy as np

from judge import near, require

EXACT = 1e-8
SWEEPS, ENDS = 20000, 1e-13  # of Gauss-Seidel: change of displacements
GAUSS = ((0.5 - math.sqrt(0.15), 5 / 18), (0.5, 4 / 9), (0.5 + math.sqrt(0.15), 5 / 18))  # exact for cells about an axis
YOUNG, POISSON, FACES, STEPS = 1000, 0.3, (8, 4), (0.5, 1, 1.5, 2, 3)
ASIDE, DOWN = "0.0014*sin(1.9*t)", "-0.001*(0.6+0.7*sin(1.1*t))"
COEFFICIENT, BOUND = "0.3*(1+0.3*x)*(1-0.1*t)", "0.15*(1+0.3*x)*(1-0.1*t)"


def value(formula, **numbers):
    return eval(formula, {"sin": math.sin}, numbers)  # pylint: disable=eval-used


def cell_stiffness(corners, nodes, model, poisson=POISSON):
    """Of a rectangle, in plane strain or around an axis."""
    lame, shear = YOUNG * poisson / ((1 + poisson) * (1 - 2 * poisson)), YOUNG / (2 * (1 + poisson))
    size = nodes[-1] - nodes[0]
    total = np.zeros((8, 8))
    for (x, u), (y, v) in itertools.product(GAUSS, repeat=2):
        shape = np.array([(x if i else 1 - x) * (y if j else 1 - y) for i, j in corners])
        slope = np.array([[(1 if i else -1) * (y if j else 1 - y) / size[0], (x if i else 1 - x) * (1 if j else -1) / size[1]] for i, j in corners])
        radius = shape @ nodes[:, 0] if model == "axisymmetric" else math.inf
        strain = np.zeros((4, 8))  # xx, yy, around, and engineering shear
        strain[0, ::2], strain[1, 1::2], strain[2, ::2], strain[3, ::2], strain[3, 1::2] = slope[:, 0], slope[:, 1], shape / radius, slope[:, 1], slope[:, 0]
        law = np.diag([2 * shear] * 3 + [shear])
        law[:3, :3] += lame
        total += strain.T @ law @ strain * u * v * np.prod(size) * (2 * math.pi * radius if math.isfinite(radius) else 1)
    return total


def assemble(model, left):
    """Nodes [num][2] and K of [left, left + 2] x [0, 1]."""
    nodes = np.array(list(itertools.product(np.linspace(left, left + 2, FACES[0] + 1), np.linspace(0, 1, FACES[1] + 1))))
    stiffness, corners = np.zeros((2 * len(nodes),) * 2), list(itertools.product((0, 1), repeat=2))
    for i, j in itertools.product(*map(range, FACES)):
        local = np.array([(i + a) * (FACES[1] + 1) + j + b for a, b in corners])
        dofs = (2 * local[:, None] + np.arange(2)).ravel()
        stiffness[np.ix_(dofs, dofs)] += cell_stiffness(corners, nodes[local], model)
    return nodes, stiffness


def weights(places, model):
    """Integrals of the shape functions of nodes on the floor."""
    found = np.zeros(len(places))
    for k, (x, weight) in itertools.product(range(len(places) - 1), GAUSS):
        length = places[k + 1] - places[k]
        around = 2 * math.pi * (places[k] + x * length) if model == "axisymmetric" else 1
        found[k:k + 2] += np.array([1 - x, x]) * weight * length * around
    return found


def solve(compliance, free, old, coefficients, bounds):
    """Forces and displacements, upwards and along the floor of each node in turn. [in] old - displacements of the last step"""
    force = np.zeros(len(free))
    for _ in range(SWEEPS):
        change = 0
        for n, t in zip(range(0, len(free), 2), range(1, len(free), 2)):
            before = force[n:n + 2].copy()
            moved = compliance[[n, t]] @ force + free[[n, t]]
            for _ in range(30):  # the two of a node
                last = force[[n, t]]
                now = moved + compliance[n:n + 2, n:n + 2] @ (last - before)
                force[n] = max(0, force[n] - now[0] / compliance[n, n])
                now = moved + compliance[n:n + 2, n:n + 2] @ (force[n:n + 2] - before)
                limit = coefficients[n // 2] * force[n] + bounds[n // 2]
                force[t] = min(max(force[t] - (now[1] - old[t]) / compliance[t, t], -limit), limit)
                if np.abs(force[[n, t]] - last).max() <= 1e-15 * np.abs(last).max():
                    break
            change = max(change, np.abs(compliance[n:n + 2, n:n + 2] @ (force[n:n + 2] - before)).max())
        if change < ENDS * np.abs(free).max():
            return force, compliance @ force + free
    raise RuntimeError("Gauss-Seidel does not end")


def expected(model, left, coefficient, bound):
    """Of each step: forces, displacements, and slips of the nodes on the floor."""
    nodes, stiffness = assemble(model, left)
    top, floor = np.flatnonzero(nodes[:, 1] == 1), np.flatnonzero(nodes[:, 1] == 0)
    held = np.concatenate([2 * top, 2 * top + 1])
    loose = np.setdiff1d(np.arange(len(stiffness)), held)
    inverse = np.linalg.inv(stiffness[np.ix_(loose, loose)])
    contact = np.searchsorted(loose, (2 * floor[:, None] + np.array([1, 0])).ravel())
    places, old = nodes[floor, 0], np.zeros(2 * len(floor))
    for t in STEPS:
        given = np.zeros(len(stiffness))
        given[2 * top], given[2 * top + 1] = value(ASIDE, t=t), value(DOWN, t=t)
        free = (inverse @ -(stiffness @ given)[loose])[contact]
        limits = [np.array([value(formula, x=x, t=t) for x in places]) for formula in (coefficient, bound)]
        force, moved = solve(inverse[np.ix_(contact, contact)], free, old, limits[0], limits[1] * weights(places, model))
        yield places, force, moved - old
        old = moved


def judge(run):
    statuses = set()
    for model, left, coefficient, bound in (("plane_strain", 0, COEFFICIENT, "0"), ("axisymmetric", 0.5, COEFFICIENT, "0"), ("axisymmetric", 0.5, "0", BOUND)):
        law = ("-floor_friction", coefficient) if bound == "0" else ("-floor_friction_bound", bound)
        done = run.again("-model", model, "-block_dm_plex_box_lower", f"{left},0", "-block_dm_plex_box_upper", f"{left + 2},1", "-block_dm_plex_box_faces", ",".join(map(str, FACES)), *law,
                         "-block_bc_displacement_top", f"{ASIDE},{DOWN}", "-load_steps", ",".join(map(str, STEPS)), name=f"{model}{law[0]}")
        rows = list(expected(model, left, coefficient, bound))
        size, farthest = max(np.abs(force).max() for _, force, _ in rows), max(np.abs(slip[1::2]).max() for _, _, slip in rows)
        for step, (places, force, slip) in zip(done.summary["steps"], rows):
            pair, told = step["pairs"]["floor"], f"{model} at t = {step['t']}"
            near(f"force, {told}", pair["normal_force"], force[::2].sum(), absolute=EXACT * size)
            if model == "plane_strain":
                near(f"friction, {told}", pair["tangential_force"][0], force[1::2].sum(), absolute=EXACT * size)
            near(f"dissipation, {told}", pair["dissipation"], -force[1::2] @ slip[1::2], absolute=EXACT * size * farthest)
        table = done.table("floor")
        order = [min(range(len(table["x"])), key=lambda row, x=x: abs(table["x"][row] - x)) for x in places]
        near(f"forces, {told}", [table["force"][row] for row in order], list(force[::2]), absolute=EXACT * size)
        near(f"slips, {told}", [table["slip_x"][row] for row, pressing in zip(order, force[::2]) if pressing > 0], list(slip[1::2][force[::2] > 0]), absolute=EXACT * farthest)
        statuses |= set(table["status"])
    require({3, 4} <= statuses, f"statuses {statuses}")
