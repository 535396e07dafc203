"""Validity of the two plates at 1, 10 and 100 times their loads. Numbers are those of an independent prototype (numerics.md, section 10), which
gives one or two digits: to 20 %. Each is then compared with its definition, evaluated anew here from the fields."""
import math

import numpy as np

from judge import near, require, same

EXPECTED = {
    "strain": [0.0038, 0.038, 0.38],
    "rotation": [0.0049, 0.049, 0.49],
    "gap": [0.003, 0.031, 0.29],
    "normal": [0.002, 0.02, 0.2],
}
RED = {"strain": 0.05, "rotation": 0.1, "gap": 0.05, "slip_cell": 2, "slip_contact": 0.1, "normal": 0.1}
BIN = 2 ** (2 / 16) - 1  # the program sorts by logarithms, 16 bins an octave; products and strains may both be off by one
GAUSS = 0.5 / math.sqrt(3)  # of the 2 x 2 points, from the middle of a cell of size 1


def gradients(x, u):
    """At 2 x 2 Gauss points of square cells whose corners are sorted from the lower left in rows: their place and grad u."""
    for a in (-GAUSS, GAUSS):
        for b in (-GAUSS, GAUSS):
            s, t = 0.5 + a, 0.5 + b
            h = x[:, 1, 0] - x[:, 0, 0]
            ds = ((1 - t) * (u[:, 1] - u[:, 0]).T + t * (u[:, 3] - u[:, 2]).T) / h
            dt = ((1 - s) * (u[:, 2] - u[:, 0]).T + s * (u[:, 3] - u[:, 1]).T) / h
            yield np.stack([ds, dt], axis=-1).transpose(1, 0, 2)  # [cell][component][direction]


def exceeded(value, weight, share):
    """The value that others exceed on this share of the weight."""
    order = np.argsort(-value)
    above = np.cumsum(weight[order])
    return value[order][np.searchsorted(above, share * above[-1])]


def sizes(run):
    """The indicators of strain and rotation, from the nodal displacements of both bodies, by squares of strains."""
    with run.fields() as file:
        points, moved, cells = (np.array(file[name]) for name in ("points", "displacement", "cells"))
    order = np.lexsort((points[cells, 0].round(9), points[cells, 1].round(9)), axis=1)
    corners = np.take_along_axis(cells, order, axis=1)
    above = np.tile(points[corners[:, 3], 1] > 0, 4)
    H = np.concatenate(list(gradients(points[corners, :2], moved[corners, :2])))
    size = np.tile(points[corners[:, 1], 0] - points[corners[:, 0], 0], 4)
    product = np.linalg.norm(0.5 * H.transpose(0, 2, 1) @ H, axis=(1, 2))
    strain = np.linalg.norm(0.5 * (H + H.transpose(0, 2, 1)), axis=(1, 2))
    turn = np.abs(0.5 * (H[:, 0, 1] - H[:, 1, 0]))
    found = [max(exceeded(value[body], (strain * size)[body] ** 2, share) for body in (above, ~above))
             for value, share in ((product, 0.01), (strain, 0.01), (turn, 0.002))]
    return found[0] / found[1], found[2]


def slip(run):
    """The larger of slips over the sizes of their contact, between nodes and partners at the same place."""
    with run.fields() as file:
        points, moved, cells, owner, status = (np.array(file[name]) for name in ("points", "displacement", "cells", "body", "status"))
        body = np.empty(len(points))
        body[cells] = owner[:, None]
    upper = (body == 0) & (points[:, 1] == 0) & (status == 1)
    below = np.flatnonzero((body == 1) & (points[:, 1] == 0))
    below = below[np.argsort(points[below, 0])]
    slips = moved[upper, 0] - np.interp(points[upper, 0], points[below, 0], moved[below, 0])
    patch, = run.summary["pairs"]["joint"]["patches"]
    common = max(np.min(slips * np.sign(slips.mean())), 0)  # both sides are one unit long
    return np.max(np.abs(slips - common * np.sign(slips.mean()))) / patch["extent"][0] + common, np.max(np.abs(slips))


def judge(run):
    steps = run.summary["steps"]
    same("times", [step["t"] for step in steps], [1, 10, 100])
    for name, values in EXPECTED.items():
        for step, value in zip(steps, values):
            if name == "gap" and step["t"] > 1:  # where it is not green, only what the bodies do not follow counts
                require(0.25 * value < step["validity"]["indicators"][name]["value"] < value, f"gap at t = {step['t']}")
                continue
            near(f"{name} at t = {step['t']}", step["validity"]["indicators"][name]["value"], value, relative=0.2)
    for step, worst in zip(steps, ("green", "amber", "red")):
        found = step["validity"]["indicators"]
        colours = [indicator["colour"] for indicator in found.values()]
        require(worst in colours and not (worst == "green" and set(colours) != {"green"}), f"colours {colours} at t = {step['t']}")
        near("load factor", step["validity"]["load_factor"], min(RED[name] / found[name]["value"] for name in RED), relative=1e-12)
        same("homogeneous", step["validity"]["homogeneous"], True)
        same("warned", [warning["code"] for warning in step["warnings"]], [] if worst == "green" else ["model_limit"])
    same("red as documented", {name: found["red"] for name, found in run.summary["validity"]["indicators"].items()}, RED)
    near("load factors are those of one theory", [100 * steps[2]["validity"]["load_factor"], 10 * steps[1]["validity"]["load_factor"]],
         [steps[0]["validity"]["load_factor"]] * 2, relative=0.15)  # the gap alone is no quadratic polynomial of the load
    once = run.again("-load_steps", "1", warns=[], name="once")
    strain, turn = sizes(once)
    indicators = once.summary["validity"]["indicators"]
    near("strain from the fields", indicators["strain"]["value"], strain, relative=BIN)
    near("rotation from the fields", indicators["rotation"]["value"], turn, relative=BIN)
    share, longest = slip(once)
    near("longest slip, as of the prototype", longest, 0.07 / 32, relative=0.2)
    near("slip from the fields", indicators["slip_contact"]["value"], share, relative=0.05)
    near("slip over a facet, or a twentieth", indicators["slip_cell"]["value"], min(32 * longest, 20 * share), relative=0.05)
    require(0 < once.summary["validity"]["friction_neglected"] < 1, "the share of friction")
    finer = run.again("-load_steps", "1", "-dm_refine", "2", warns=[], name="finer").summary["validity"]["indicators"]
    for name in ("strain", "rotation"):  # maxima would grow at the corners, by a quarter with each refinement
        near(f"{name} on the finer mesh", finer[name]["value"], EXPECTED[name][0], relative=0.2)
    near("slip on the finer mesh", finer["slip_contact"]["value"], indicators["slip_contact"]["value"], relative=0.1)
    near("slip over a twentieth of the patch, which has 42 facets", finer["slip_cell"]["value"], 20 * finer["slip_contact"]["value"], relative=1e-9)
    fine = run.again("-load_steps", "1", "-order", "2", warns=[], name="order").summary["validity"]["indicators"]
    near("slip over the contact, order 2", fine["slip_contact"]["value"], share, relative=0.2)
    if run.ranks == 1:
        other = run.again("-load_steps", "1", ranks=3, warns=[], name="ranks").summary["validity"]["indicators"]
        for name, indicator in other.items():
            near(f"{name} on three ranks", indicator["value"], indicators[name]["value"], relative=1e-8)
            near(f"place of {name} on three ranks", indicator["at"], indicators[name]["at"], absolute=1e-9)
