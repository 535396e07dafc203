"""A third solver, of other authors. The scene is assembled here once more (bilinear quads, trilinear hexahedra) and condensed to the nodes on the
rigid floor. Its friction is solved by Siconos, where Python has that. On a floor the dual multipliers of a node are forces of that node."""
import itertools
import pathlib

import numpy as np

from judge import near, require

try:
    import siconos.numerics as siconos
except ImportError:
    siconos = None

EXACT = 1e-8


def box_stiffness(faces, lower, upper, young, poisson):
    """Nodes of a box of bricks, K, and the nodal volumes."""
    dim = len(faces)
    axes = [np.linspace(a, b, n + 1) for a, b, n in zip(lower, upper, faces)]
    nodes = np.array(list(itertools.product(*axes)))
    number = np.arange(len(nodes)).reshape([n + 1 for n in faces])
    sizes = [(b - a) / n for a, b, n in zip(lower, upper, faces)]
    corners = list(itertools.product((0, 1), repeat=dim))
    lame, shear = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))
    cell = np.zeros((len(corners) * dim,) * 2)
    for place in itertools.product((0.5 - 0.5 / 3**0.5, 0.5 + 0.5 / 3**0.5), repeat=dim):
        grad = np.array([[np.prod([(x if c else 1 - x) if j != k else (1 if c else -1) / sizes[k] for j, (x, c) in enumerate(zip(place, corner))]) for k in range(dim)] for corner in corners])
        for a, b in itertools.product(range(len(corners)), repeat=2):
            block = lame * np.outer(grad[a], grad[b]) + shear * np.outer(grad[b], grad[a]) + shear * grad[a] @ grad[b] * np.eye(dim)
            cell[a * dim:(a + 1) * dim, b * dim:(b + 1) * dim] += block * np.prod(sizes) / 2**dim
    stiffness, volumes = np.zeros((len(nodes) * dim,) * 2), np.zeros(len(nodes))
    for first in itertools.product(*(range(n) for n in faces)):
        local = np.array([number[tuple(f + c for f, c in zip(first, corner))] for corner in corners])
        dofs = (local[:, None] * dim + np.arange(dim)).ravel()
        stiffness[np.ix_(dofs, dofs)] += cell
        volumes[local] += np.prod(sizes) / 2**dim
    return nodes, stiffness, volumes


def solve(dim, compliance, free, mu):
    """Forces and displacements of contact nodes: u = W r + u_free, normal first, r in the cones, Signorini and Coulomb."""
    scale, size = np.abs(compliance).max(), np.abs(free).max()
    count = len(free) // dim
    problem = siconos.FrictionContactProblem(dim, compliance / scale, free / size, np.full(count, float(mu)))
    forces, moved = np.zeros(len(free)), np.zeros(len(free))
    options = siconos.SolverOptions(siconos.SICONOS_FRICTION_3D_NSGS if dim == 3 else siconos.SICONOS_FRICTION_2D_NSGS)
    options.iparam[siconos.SICONOS_IPARAM_MAX_ITER] = 100000
    options.dparam[siconos.SICONOS_DPARAM_TOL] = 1e-11
    status = (siconos.fc3d_nsgs if dim == 3 else siconos.fc2d_driver)(problem, forces, moved, options)
    require(status in (0, None), f"Siconos ends with {status}")
    return forces * size / scale, moved * size


def condense(stiffness, loads, held, contact):
    """W and the displacement without contact, in the directions of contact nodes: upwards, then along the floor. [contact] - dofs"""
    left = np.setdiff1d(np.arange(len(loads)), held)
    inverse = np.linalg.inv(stiffness[np.ix_(left, left)])
    places = np.searchsorted(left, contact)
    return inverse[np.ix_(places, places)], (inverse @ loads[left])[places]


def block_scene(run):
    """The scene of this test, assembled: nodes, dofs held, loads."""
    lines = pathlib.Path(run.arguments[1]).read_text().splitlines()
    scene = dict(line.split(maxsplit=1) for line in lines if line.startswith("-"))
    numbers = lambda key: [float(x) for x in scene[key].split(",")]
    faces = [int(n) for n in numbers("-block_dm_plex_box_faces")]
    lower, upper = numbers("-block_dm_plex_box_lower"), numbers("-block_dm_plex_box_upper")
    dim = len(faces)
    nodes, stiffness, volumes = box_stiffness(faces, lower, upper, *numbers("-block_young"), *numbers("-block_poisson"))
    loads = np.outer(volumes, numbers("-block_body_force")).ravel()
    top = np.flatnonzero(np.isclose(nodes[:, -1], upper[-1]))
    held = (top[:, None] * dim + np.arange(dim)).ravel()
    given = np.zeros(len(loads))
    given[held] = np.tile(numbers("-block_bc_displacement_top"), len(top))
    loads -= stiffness @ given
    floor = np.flatnonzero(np.isclose(nodes[:, -1], lower[-1]))
    order = [dim - 1, *range(dim - 1)]
    contact = (floor[:, None] * dim + np.array(order)).ravel()
    return dim, nodes[floor], condense(stiffness, loads, held, contact), float(scene["-floor_friction"])


def judge(run):
    if siconos is None:
        print("Siconos is not there: only the run itself is judged")
        return
    dim, places, (compliance, free), mu = block_scene(run)
    forces, moved = solve(dim, compliance, free, mu)
    table = run.table("floor")
    scale, size = np.abs(forces).max(), np.abs(moved).max()
    axes = "xyz"[:dim]
    kinds = set()
    for a, place in enumerate(places):
        row = min(range(len(table["x"])), key=lambda r: sum((table[axis][r] - x) ** 2 for axis, x in zip(axes, place)))
        kinds.add(table["status"][row])
        near(f"normal force at {place}", table["force"][row], forces[a * dim], absolute=EXACT * scale)
        near(f"gap at {place}", table["gap"][row], moved[a * dim], absolute=EXACT * size)
        area = table["force"][row] / table["pressure"][row] if table["pressure"][row] else 0
        for k in range(dim - 1):
            near(f"friction at {place}", area * table[f"tangential_traction_{axes[k]}"][row], forces[a * dim + 1 + k], absolute=EXACT * scale)
            near(f"slip at {place}", table[f"slip_{axes[k]}"][row], moved[a * dim + 1 + k], absolute=EXACT * size)
    require(kinds == {0, 3, 4}, f"statuses {kinds}")
