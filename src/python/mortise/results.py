"""Files of a finished run: the summary, tables and fields. mortise-plot and mortise-report read by these functions, too."""
from __future__ import annotations

import csv
import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .errors import ResultError

Array = np.ndarray[Any, np.dtype[Any]]
NODES = {2: 2, 34: 3, 4: 3, 5: 4, 36: 6, 35: 9, 6: 4, 9: 8, 38: 10, 50: 27}  # XDMF's number of a cell: nodes
ENDINGS = (".json", ".h5", ".xdmf", ".html", ".vtu")
# Names of cells by dimension and number of nodes, those of meshio.
KINDS = {2: {3: "triangle", 6: "triangle6", 4: "quad", 9: "quad9"}, 3: {4: "tetra", 10: "tetra10", 8: "hexahedron", 27: "hexahedron27"}}


# --- summary ----------------------------------------------------------------------------------------------------------


class Summary(dict[str, Any]):
    """The JSON summary, or an object in it: a dictionary whose keys are attributes, too.

    `summary.pairs.fit.normal_force` is `summary["pairs"]["fit"]["normal_force"]`. Only brackets give a key that is no name in Python, and
    one that a dictionary has as a method ("items"). Null is None."""

    def __getattr__(self, key: str) -> Any:
        try:
            return self[key]
        except KeyError:
            raise AttributeError(f"there is no {key!r}; there are {', '.join(self)}") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    def value(self, path: str) -> Any:
        """The value at a path, "pairs.fit.force.0": keys, and numbers of items of a list, with dots between them.

        Raises KeyError with the keys that exist."""
        found: Any = self
        rest = path
        while rest:
            if isinstance(found, Mapping):
                step = max((key for key in found if rest == key or rest.startswith(key + ".")), key=len, default=None)
            else:
                step = rest.split(".")[0] if isinstance(found, list) else None
            try:
                found = found[int(str(step))] if isinstance(found, list) else found[step]
            except (KeyError, IndexError, TypeError, ValueError):
                known = ", ".join(found) if isinstance(found, Mapping) else f"{len(found)} items" if isinstance(found, list) else "a single value"
                raise KeyError(f"{path}: there is no {rest}; there is {known}") from None
            rest = rest[len(str(step)) + 1:]
        return found


def read_summary(prefix: str) -> Summary:
    """The summary of the run whose -output was the prefix."""
    try:
        with open(f"{prefix}.json", encoding="utf-8") as file:
            summary: Summary = json.load(file, object_hook=Summary)
            return summary
    except OSError as error:
        raise ResultError(f"cannot read {prefix}.json ({error.strerror}); give the -output prefix of a finished run") from None
    except ValueError:
        raise ResultError(f"{prefix}.json is not a summary of mortise") from None


# --- tables -----------------------------------------------------------------------------------------------------------


def column_of(name: str, words: list[str]) -> Array:
    """A column as numbers, an empty field as NaN; or, if not all are numbers, as text. Names of paths are text, whatever they are."""
    try:
        if name == "path":
            raise ValueError
        return np.array([float(word or "nan") for word in words], dtype=float)
    except ValueError:
        return np.array(words, dtype=str)


def read_table(path: str) -> Array:
    """A CSV file as a structured array, one entry for each row: table["pressure"], table[0]["x"]. Columns are of float or of text."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            names, *rows = csv.reader(line for line in file if not line.startswith("#"))
        columns = [column_of(name, [row[i] for row in rows]) for i, name in enumerate(names)]
    except OSError as error:
        raise ResultError(f"cannot read {path} ({error.strerror}); was the run finished, and does its scene have that table?") from None
    except (ValueError, IndexError):
        raise ResultError(f"{path} is not a table of mortise") from None
    names = [name.strip() for name in names]
    table = np.zeros(len(rows), dtype=[(name, column.dtype) for name, column in zip(names, columns)])
    for name, column in zip(names, columns):
        table[name] = column
    return table


def read_pair(prefix: str, pair: str) -> Array:
    """The nodes of the nonmortar side of a pair, <prefix>_<pair>.csv: x, y, (z,) pressure, gap, status (whole), force, (arc_length), with
    friction tangential_traction_x .., slip_x .."""
    table = read_table(f"{prefix}_{pair}.csv")
    names = table.dtype.names or ()
    try:
        if not {"x", "y", "pressure", "status"} <= set(names):
            raise ValueError
        return table.astype([(name, int if name == "status" else float) for name in names])
    except ValueError:
        raise ResultError(f"{prefix}_{pair}.csv is not a table of mortise") from None


# --- fields -----------------------------------------------------------------------------------------------------------


def read_datasets(prefix: str, needed: Iterable[str], optional: Iterable[str] = ()) -> dict[str, Array]:
    """Datasets of <prefix>.h5 by name; those that are optional only where they exist. options/GUIDE.md has their shapes."""
    try:
        import h5py  # type: ignore[import-untyped]  # pylint: disable=import-outside-toplevel  # takes longer than all else
    except ImportError:
        raise ResultError("fields are read by h5py, which this Python does not have: pip install h5py") from None

    name = f"{prefix}.h5"
    if not os.path.isfile(name):
        raise ResultError(f"cannot read {name} (no such file); run mortise with -output and the xdmf format")
    try:
        with h5py.File(name, "r") as file:
            return {key: file[key][()] for key in (*needed, *(key for key in optional if key in file))}
    except (OSError, KeyError) as error:
        raise ResultError(f"{name} is not a result of mortise ({error})") from None


def read_cells(data: Array) -> list[Array]:
    """The dataset `cells` as blocks [cells][nodes] of one type each, in the order of the file."""
    if data.ndim == 2:
        return [data]
    cells, at = [], 0
    while at < len(data):  # blocks of one type: number, points, number, points ...
        width = NODES[int(data[at])] + 1
        kinds = data[at::width]
        count = int(np.argmax(kinds != data[at])) or len(kinds)
        cells.append(data[at:at + count * width].reshape(count, width)[:, 1:])
        at += count * width
    return cells


@dataclass
class BodyFields:
    """Fields of one body at its n nodes; vectors have three components, in the plane the third is 0. None: the file does not have it.

    nodes [n]: numbers of the points in the file, where a node between two regions is two points; pieces, regions: number of the piece and
    of the region of each cell, by kind as cells
    points [n][3]: undeformed (length); cells: {"triangle" | "triangle6" | "quad" | "quad9" | "tetra" | "tetra10" | "hexahedron" |
    "hexahedron27": [cells][nodes]}, rows of this body's arrays
    displacement [n][3] (length); stress [n][3][3], von_mises [n], principal [n][3], the largest first (stress)
    pressure [n] (stress), gap [n] (length), status [n] (1 contact, 0 open, 2 tied, 3 slips, 4 sticks, -1 without a multiplier): 0, NaN, -1 off contact sides
    motion [n][3]: only without a solution, the motion that nothing resists"""

    name: str
    nodes: Array
    points: Array
    cells: dict[str, Array]
    pieces: dict[str, Array] | None = None
    regions: dict[str, Array] | None = None
    displacement: Array | None = None
    stress: Array | None = None
    von_mises: Array | None = None
    principal: Array | None = None
    pressure: Array | None = None
    gap: Array | None = None
    status: Array | None = None
    motion: Array | None = None


NODAL = ("displacement", "stress", "von_mises", "principal", "pressure", "gap", "status", "motion")


def read_fields(prefix: str, summary: Mapping[str, Any]) -> dict[str, BodyFields]:
    """Fields of all bodies by name, from <prefix>.h5."""
    data = read_datasets(prefix, ("points", "cells", "body"), (*NODAL, "piece", "region"))
    blocks, bodies = read_cells(data["cells"]), {}
    starts = np.cumsum([0, *map(len, blocks)])
    if "stress" in data:
        data["stress"] = data["stress"].reshape(-1, 3, 3)
    for number, (name, about) in enumerate(summary["scene"]["bodies"].items()):
        own = [(block, slice(start, end), data["body"][start:end] == number) for block, start, end in zip(blocks, starts, starts[1:])]
        own = [(block[mine], where, mine) for block, where, mine in own if mine.any()]
        nodes = np.unique(np.concatenate([block.ravel() for block, *_ in own])) if own else np.zeros(0, dtype=int)
        local = np.full(len(data["points"]), -1)
        local[nodes] = np.arange(len(nodes))
        kinds = [KINDS[summary["scene"]["dimension"]][block.shape[1]] for block, *_ in own]
        bodies[name] = BodyFields(name, nodes, data["points"][nodes], {kind: local[block] for kind, (block, *_) in zip(kinds, own)},
                                  *({kind: data[key][where][mine] for kind, (_, where, mine) in zip(kinds, own)} if key in data else None
                                    for key in ("piece", "region")),
                                  **{key: data[key][nodes] for key in NODAL if key in data})
        if len(nodes) != about["nodes"] and not (about.get("regions") and len(nodes) > about["nodes"]):
            raise ResultError(f"{prefix}.h5 has {len(nodes)} nodes of {name}, the summary has {about['nodes']}: they are of different runs")
    return bodies


SURFACE = ("points", "displacement", "pressure", "gap", "status", "normal", "cells")


def read_surface(prefix: str, pair: str) -> dict[str, Any]:
    """The nonmortar side of a pair, <prefix>_<pair>.h5: points, displacement, normal [n][3], pressure, gap, status [n]; with friction tangential_traction, slip
    [n][3]; cells as read, and `blocks`: the same as [facets][nodes] of one type each."""
    surface: dict[str, Any] = read_datasets(f"{prefix}_{pair}", SURFACE, ("tangential_traction", "slip"))
    surface["blocks"] = read_cells(surface["cells"])
    return surface


# --- all of it --------------------------------------------------------------------------------------------------------


class Results:
    """The files of a finished run, each read where it is asked for. prefix: what was given as -output, None if nothing was."""

    def __init__(self, prefix: str | None, summary: Summary | None = None):
        self.prefix, self._summary = prefix, summary

    @property
    def summary(self) -> Summary | None:
        """The JSON summary (options/GUIDE.md, Summary); None if the run ended before there was one."""
        return self._summary

    @property
    def warnings(self) -> list[Summary]:
        """What the program warned of: code, text, advice, at, and body or pair."""
        return self._summary.get("warnings", []) if self._summary else []

    @property
    def solved(self) -> bool:
        """Whether the answer holds."""
        return self._summary is not None and self._summary["status"] == "solved"

    def files(self) -> str:
        """The prefix of the files. Raises ResultError where the run wrote none."""
        if self.prefix is None:
            raise ResultError("this run has written no files; give it an output")
        return self.prefix

    def table(self, pair: str) -> Array:
        """The nodes of the nonmortar side of a pair as a structured array (options/GUIDE.md, Files)."""
        return read_pair(self.files(), pair)

    def study(self) -> Array:
        """The runs of a study as a structured array, one row for each order and level."""
        return read_table(f"{self.files()}_study.csv")

    def steps(self) -> Array:
        """The load steps as a structured array, one row for each: `t`, `<pair>.normal_force`, ..."""
        return read_table(f"{self.files()}_steps.csv")

    def paths(self) -> Array:
        """Displacement and stress at the points of all -paths, a column `path` with their names; NaN outside the body."""
        return read_table(f"{self.files()}_paths.csv")

    def fields(self) -> dict[str, BodyFields]:
        """Fields by the name of the body."""
        return read_fields(self.files(), self._summary or read_summary(self.files()))

    def surface(self, pair: str) -> dict[str, Any]:
        """The nonmortar side of a pair as a surface, in the plane as a line: see read_surface()."""
        return read_surface(self.files(), pair)


def load(prefix: str | os.PathLike[str]) -> Results:
    """The results that an earlier run has written."""
    name = os.fspath(prefix)
    name = next((name[:-len(ending)] for ending in ENDINGS if name.endswith(ending)), name)
    return Results(name, read_summary(name))
