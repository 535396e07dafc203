"""A load that friction holds, though a state that slides on and on, with a small rho, cannot: no certain refusal. The equilibrium is that of bilinear cells of this test, condensed to the nodes on the floor."""
import itertools

import numpy as np

from history import YOUNG, cell_stiffness
from judge import Run, require

FACES, SIDE, LOAD = (3, 2), 1.29, 8.9
COEFFICIENTS, GAPS = (0, 1.2, 0, 5.8), (-0.006, -0.0082, 0.0033, 0.002)
STICKS, CLOSED = (1, 3), (0, 1, 3)  # nodes; the others have no friction


def equilibrium(poisson):
    """Pressing and resisting force of each node on the floor, how far it is above the floor, and its slip."""
    corners = list(itertools.product((0, 1), repeat=2))
    nodes = np.array(list(itertools.product(np.linspace(0, SIDE, FACES[0] + 1), np.linspace(0, 1, FACES[1] + 1))))
    stiffness, load = np.zeros((2 * len(nodes),) * 2), np.zeros(2 * len(nodes))
    for i, j in itertools.product(*map(range, FACES)):
        local = np.array([(i + a) * (FACES[1] + 1) + j + b for a, b in corners])
        dofs = (2 * local[:, None] + np.arange(2)).ravel()
        stiffness[np.ix_(dofs, dofs)] += cell_stiffness(corners, nodes[local], "plane_strain", poisson)
    for low in range(FACES[1]):  # the traction at both ends of a side varies linearly
        size, ends = 1 / FACES[1], [LOAD * (4 - 6 * (low + k) / FACES[1]) for k in (0, 1)]
        load[2 * low] += size * (ends[0] / 3 + ends[1] / 6)
        load[2 * low + 2] += size * (ends[0] / 6 + ends[1] / 3)
    floor, top = np.flatnonzero(nodes[:, 1] == 0), np.flatnonzero(nodes[:, 1] == 1)
    held = np.concatenate([2 * top + 1, 2 * floor[list(CLOSED)] + 1, 2 * floor[list(STICKS)]])
    moved = np.zeros(len(load))
    moved[2 * floor[list(CLOSED)] + 1] = [-GAPS[a] for a in CLOSED]
    loose = np.setdiff1d(np.arange(len(load)), held)
    moved[loose] = np.linalg.solve(stiffness[np.ix_(loose, loose)], (load - stiffness @ moved)[loose])
    force = stiffness @ moved - load
    return force[2 * floor + 1], -force[2 * floor], moved[2 * floor + 1] + np.array(GAPS), moved[2 * floor]


def judge(run):
    pressed, resists, above, slips = equilibrium(0.45)
    require(YOUNG == 1000 and all(pressed[list(CLOSED)] > 0) and above[2] > 0 and max(abs(slips[list(STICKS)])) == 0, f"no equilibrium: {pressed}, {above}")
    require(all(abs(resists[a]) < 0.999 * COEFFICIENTS[a] * pressed[a] for a in STICKS), f"friction {resists}, pressed {pressed}")
    for solver in ("cholesky", "truncatedmg"):
        done = Run(run.program, run.mpiexec, run.ranks, run.folder / solver, [*run.arguments, "-pc_type", solver])
        require(done.exit in (0, 3), f"{solver}: exit {done.exit}: {done.stderr}")
