"""A corner of three planes, upright and askew: uniform stress, whatever the cells, in all nodes with one, two and three contacts.

Nothing but contacts holds the workpiece: springs that fade away do so to 1e-10 of the loads.
"""
import itertools

import numpy as np

from judge import near, same

CLAMPS = {"wall": 3, "stop": 2, "floor": 5}
LENGTHS = {"wall": 2, "stop": 1.5, "floor": 1}
YOUNG, POISSON = 70000, 0.33


def rotation():
    """Some rotation, as columns."""
    q, r = np.linalg.qr(np.array([[0.4, -0.9, 0.3], [0.8, 0.1, -0.7], [0.2, 0.6, 0.5]]))
    q = q * np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


def judge_run(run, turn):
    stress = -np.array(list(CLAMPS.values()), dtype=float)
    for axis, (name, clamp) in enumerate(CLAMPS.items()):
        pair, table = run.pair(name), run.table(name)
        near(f"pressure of {name}", table["pressure"], [clamp] * len(table["pressure"]), relative=1e-10)
        same(f"nodes of {name} in contact", pair["active_nodes"], len(table["pressure"]))
        area = np.prod(list(LENGTHS.values())) / LENGTHS[name]
        near(f"force of {name}", pair["force"], list(clamp * area * turn[:, axis]), relative=1e-10)
    s = turn @ np.diag(stress) @ turn.T
    probe = run.probe("inside")
    near("stress", probe["stress"], [s[0, 0], s[1, 1], s[2, 2], s[1, 2], s[0, 2], s[0, 1]], relative=1e-10)
    strain = ((1 + POISSON) * stress - POISSON * sum(stress)) / YOUNG
    near("displacement", probe["displacement"], list(turn @ (strain * np.array([0.7, 0.8, 0.6]))), relative=1e-10)


def judge(run):
    judge_run(run, np.eye(3))
    for cells, order in run.some(itertools.product("01", "12")):
        kind = ["-workpiece_dm_plex_simplex", cells, "-order", order, "-workpiece_dm_plex_box_faces", "3,2,2"]
        judge_run(run.again(*kind, name=f"upright{cells}{order}"), np.eye(3))
        turn = rotation()
        lines = [" + ".join(f"({value!r})*{x}" for value, x in zip(map(float, row), "xyz")) for row in turn]
        place = [f"-{name}_obstacle_normal={','.join(repr(float(v)) for v in turn[:, axis])}" for axis, name in enumerate(CLAMPS)]
        options = [part for option in place for part in option.split("=")]
        at = ",".join(repr(float(x)) for x in turn @ [0.7, 0.8, 0.6])
        askew = run.again(*kind, *options, "-workpiece_map", ", ".join(lines), "-probe_inside_at", at, name=f"askew{cells}{order}")
        judge_run(askew, turn)
