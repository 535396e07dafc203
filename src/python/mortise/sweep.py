"""The same scene with many values of its options."""
from __future__ import annotations

import concurrent.futures
import csv
import itertools
import os
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Union

import numpy as np

from .errors import MortiseError
from .program import Limits, Run, find_program, run_quietly
from .results import Array
from .scene import flatten

Column = Union[str, Callable[[Run], Any]]
COMMON = ("status", "exit_code", "seconds", "warnings", "message")  # columns that every row has


class Rows(list[dict[str, Any]]):
    """Rows of a sweep: dictionaries with the same keys. Those are the options that vary, and the columns that were asked for, None where a
    run has none. There are also `status` ("solved", "no_solution", "not_converged", "wrong", "failed"), `exit_code`, `seconds`,
    `warnings` (codes, with blanks between them) and `message` (the program's sentence, "" where it is solved)."""

    def column(self, name: str) -> Array:
        """A column as an array; None becomes NaN in a column of numbers."""
        values = [row[name] for row in self]
        if any(isinstance(value, float) or value is None for value in values) and all(isinstance(value, (int, float, type(None))) for value in values):
            return np.array([np.nan if value is None else value for value in values], dtype=float)
        return np.array(values)

    @property
    def failed(self) -> Rows:
        """Rows of runs that are not solved."""
        return Rows(row for row in self if row["exit_code"] != 0)

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the rows as CSV, which read_table() reads; None is an empty field."""
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(self[0]) if self else [], restval="", lineterminator="\n")
            writer.writeheader()
            writer.writerows(self)


def grid(**values: Any) -> list[dict[str, Any]]:
    """All combinations of the values of options, the last one varying fastest: grid(order=(1, 2), dm_refine=range(3)) has six. A number or a
    text is the same in all of them."""
    lists = [value if isinstance(value, Iterable) and not isinstance(value, str) else [value] for value in values.values()]
    return [dict(zip(values, point)) for point in itertools.product(*lists)]


def value_of(column: Column, run: Run) -> Any:
    """A column of a run: the value of the summary at a path, or of a function; None where the run has none."""
    if callable(column):
        return column(run) if run.solved else None
    try:
        return run.summary.value(column) if run.summary else None
    except KeyError:
        if run.solved:
            raise
        return None


def options_of(point: Mapping[str, Any]) -> dict[str, Any]:
    """The options of a point for its row: numbers as they are, sequences as in an options file, {"hub": {"young": 1}} as hub_young."""
    row: dict[str, Any] = {}
    for name, value in point.items():
        plain = value is None or isinstance(value, (str, int, float))
        row.update({name: value} if plain else flatten({name: value}))
    return row


def row_of(point: Mapping[str, Any], columns: Mapping[str, Column], run: Run | None, message: str) -> dict[str, Any]:
    """A row. run: None where the run did not come to its end"""
    code = run.exit_code if run else None
    status = run.summary["status"] if run and run.summary else "wrong" if code == 1 else "failed"
    codes = " ".join(dict.fromkeys(warning["code"] for warning in run.warnings)) if run else ""
    common = zip(COMMON, (status, code, run.seconds if run else None, codes, message))
    return {**options_of(point), **{name: value_of(column, run) if run else None for name, column in columns.items()}, **dict(common)}


def sweep(scene: str | os.PathLike[str] | Mapping[str, Any], points: Iterable[Mapping[str, Any]], columns: Mapping[str, Column], *,
          output: str | os.PathLike[str] | None = None, workers: int | None = None, ranks: int = 1, timeout: float | None = None,
          program: str | None = None) -> Rows:
    """Solves a scene once for each point, several runs at a time, and makes a table of them.

    scene: as of run(); points: overrides of each run, all with the same options; see grid()
    columns: {name: path in the summary ("pairs.fit.normal_force") or a function of the Run}, called where it is solved
    output: prefix of the files; run i has <output>_<i> from 1 on, with zeros before it. Without it there are no files
    workers: runs at a time, else the number of processors over the ranks; ranks, timeout, program: as of run()

    Returns the rows in the order of the points. A run that is not solved is a row with its exit code and message, and ends nothing. A
    timeout is a row with status "failed". A path that a solved run does not have raises KeyError."""
    todo = [dict(point) for point in points]
    names = {name for point in todo for name in point}
    if any(set(point) != names for point in todo):
        raise ValueError("all points need the same options")
    twice = (names | set(COMMON)) & set(columns) | names & set(COMMON)
    if twice:
        raise ValueError(f"these columns have two meanings: {', '.join(sorted(twice))}")
    processors = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    workers = workers or max(1, processors // ranks)
    stop = threading.Event()
    limits = Limits(timeout, stop, max(1, processors // (workers * ranks)))
    program, digits = program or find_program(), len(str(len(todo)))

    def solve(number: int) -> dict[str, Any]:
        prefix = f"{os.fspath(output)}_{number + 1:0{digits}}" if output is not None else None
        try:
            run = run_quietly(scene, todo[number], prefix, ranks, program, limits)
        except MortiseError as error:
            return row_of(todo[number], columns, None, error.sentence)
        return row_of(todo[number], columns, run, run.sentence)

    return Rows(in_parallel(solve, range(len(todo)), workers, stop))


def in_parallel(solve: Callable[[int], dict[str, Any]], numbers: Sequence[int], workers: int, stop: threading.Event) -> list[dict[str, Any]]:
    """Rows in order. Threads wait for the runs, which are processes; an exception, such as Ctrl-C, ends those that are under way."""
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        futures = [pool.submit(solve, number) for number in numbers]
        try:
            done, _ = concurrent.futures.wait(futures, return_when=concurrent.futures.FIRST_EXCEPTION)
            for future in done:
                future.result()  # raises its exception, if it has one, before others are waited for
            return [future.result() for future in futures]
        except BaseException:
            stop.set()
            pool.shutdown(wait=False, cancel_futures=True)
            raise
