"""The fields of a run against the tables of independent.py in the folder of its scene, every number of every column.

Displacements at all nodes come from the HDF5 file, the contact side from the CSV table. Tolerances are relative to the largest
value of a column; a column that ought to vanish is compared with what rounding makes of the other quantities of its kind.
"""
import math
import pathlib

import numpy as np

from judge import read_table, require, same, same_table
from meshes import bodies_of_nodes

RELATIVE = 1e-10  # of a column's largest value: both sides solve the same equations to rounding, conditions are below 1e5
VANISHING = 1e-12  # of the largest displacement or stress: allowed beside it, for columns that are zero but for rounding


def read_fields(file):
    """All nodal numbers of an HDF5 file as a table; gaps where there is no constraint count as 0, as their status tells."""
    points, stress = file["points"][()], file["stress"][()].reshape(-1, 9)
    table = {"body": bodies_of_nodes(file["cells"][()], file["body"][()], len(points)), "x": points[:, 0], "y": points[:, 1], "z": points[:, 2]}
    table.update({name: file["displacement"][:, k] for k, name in enumerate(("u_x", "u_y", "u_z"))})
    table.update({f"stress_{k}": stress[:, k] for k in range(9)})
    table.update({name: file[name][()] for name in ("von_mises", "pressure", "status", "gap")})
    require(np.array_equal(np.isnan(table["gap"]), table["status"] < 0), "gaps are not NAN just where there is no constraint")
    table["gap"] = np.nan_to_num(table["gap"])
    return {name: values.tolist() for name, values in table.items()}


def largest(table, *columns):
    """Of what is known: in plane strain a full Hooke tensor leaves the stress across the plane open."""
    return max(abs(value) for column in columns for value in table[column] if not math.isnan(value))


def displacements(table):
    return [name for name in table if name.startswith("u_")]


def same_nodes(table, expected, columns, relative=RELATIVE):
    """Columns of two node tables, matched by body and place."""
    length = largest(expected, *displacements(expected))
    stress = largest(expected, "von_mises") if "von_mises" in expected else 0.0
    size = {name: length if name in ("u_x", "u_y", "u_z", "gap") else stress for name in columns}
    tolerances = {name: (0, 0) if name == "status" else (relative, VANISHING * size[name]) for name in columns}
    same_table(table, expected, tolerances, position=("body", "x", "y", "z"))


def same_side(table, expected, sizes, relative=RELATIVE):
    """A pair's table. [in] sizes - largest displacement and stress of the scene"""
    known = lambda gaps: [0.0 if math.isnan(gap) else gap for gap in gaps]
    for status, gap in zip(table["status"], table["gap"]):
        same("a gap is not known", math.isnan(gap), status < 0)
    length, stress = (max(VANISHING, relative * VANISHING / RELATIVE) * size for size in sizes)
    mine = {**table, "p": table["pressure"], "active": table["status"], "gap": known(table["gap"])}
    same_table(mine, {**expected, "gap": known(expected["gap"])},
               {"active": (0, 0), "p": (relative, stress), "force": (relative, stress), "gap": (relative, length)})


def scene_folder(run):
    """Where the options file of the run is, and with it the tables."""
    return pathlib.Path(run.arguments[run.arguments.index("-options_file") + 1]).parent


def same_tables(run, nodes, sides, relative=RELATIVE):
    """[in] nodes - table of all nodes; [in] sides - {pair: table}"""
    with run.fields() as file:
        table = read_fields(file)
    same_nodes(table, nodes, displacements(nodes), relative)
    same("tables", sorted(sides), sorted(run.summary["pairs"]))
    for pair, side in sides.items():
        same_side(run.table(pair), side, (largest(nodes, *displacements(nodes)), largest(table, "von_mises")), relative)


def judge(run):
    folder = scene_folder(run)
    tables = {path.stem: read_table(path) for path in folder.glob("*.csv")}
    same_tables(run, tables.pop("nodes"), tables)
