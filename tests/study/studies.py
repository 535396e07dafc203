"""studies.py -- what the tests of studies share: their files as they are read back, and what every study has."""
import math
import pathlib
import re
import subprocess
import xml.etree.ElementTree

from judge import NAME, near, read_table, require, same

COST = re.compile(r"^(seconds|peak)_")  # columns that no two runs have in common
STAGES = ("setup", "mortar", "assembly", "condense", "solve", "output")
FINEST = "_to_finest"  # what the table adds to names of errors that are differences from the finest run
PLOT = pathlib.Path(__file__).parents[2] / "src" / "plot" / "mortise-plot"
SVG = "{http://www.w3.org/2000/svg}"


def rows(run):
    """The table of a study: a dictionary for each run."""
    columns = read_table(run.folder / f"{NAME}_study.csv")
    return [dict(zip(columns, values)) for values in zip(*columns.values())]


def block(run):
    """The block "study" of the summary."""
    return run.summary["study"]


def one(table, order, level):
    """The run of an order on a level."""
    return next(row for row in table if (row["order"], row["level"]) == (order, level))


def words(run):
    """All texts of the chart that mortise-plot draws, which has to be well-formed."""
    subprocess.run([PLOT, run.folder / f"{NAME}_study"], check=True, capture_output=True)
    root = xml.etree.ElementTree.parse(run.folder / f"{NAME}_study.svg").getroot()
    same("root of the chart", root.tag, SVG + "svg")
    return ["".join(text.itertext()) for text in root.iter(SVG + "text")]


def judge_files(run, orders, levels):
    """Rows in the order in which they are made, the same in table and summary, and a chart with a line for each order."""
    table, runs = rows(run), block(run)["runs"]
    same("runs", [(row["level"], row["order"]) for row in table], [(level, order) for level in range(levels) for order in orders])
    same("runs in the summary", len(runs), len(table))
    for row, told in zip(table, runs):
        same("columns", [name.replace(FINEST, "") for name in row], list(told))
        for name, value in row.items():
            other = told[name.replace(FINEST, "")]
            require(other is None and value != value or other == value, f"{name} is {value} in the table, {other} in the summary")
        require(row["status"] == "solved" and row["reason"] == "", "a run is not solved")
        require(row["peak_bytes"] > 0 and row["seconds_processor"] > 0, "a run took nothing")
        near("total", row["seconds_total"], sum(row[f"seconds_{stage}"] for stage in STAGES), relative=1e-12)
        coarser = sum(r["seconds_total"] for r in table if r["order"] == row["order"] and r["level"] <= row["level"])
        near("total with coarser runs", row["seconds_with_coarser"], coarser, relative=1e-12)
    texts = words(run)
    for order in orders:
        same(f"names of order {order} in the chart", texts.count(f"order {order}"), 2)
    same("slopes in the chart", sum(text.startswith("slope ") for text in texts), 2 * len(orders))


def tolerance(row, name, relative):
    """Absolute, of one column: an error is known as well as the solution it belongs to, a stress as well as the largest one."""
    if name.endswith("_rate"):
        return 1e3 * relative
    if name.endswith("_relative"):
        return relative
    if name + "_relative" in row:
        return relative * row[name] / row[name + "_relative"]
    if name.endswith("_von_mises"):
        return relative * max(value for other, value in row.items() if other.endswith("_von_mises"))
    return relative * abs(row[name])


def judge_same(run, other, relative):
    """All columns but those of cost."""
    for row, reference in zip(rows(run), rows(other)):
        for name, value in reference.items():
            if COST.match(name):
                continue
            if isinstance(value, str) or math.isnan(value):
                require(str(row[name]) == str(value), f"{name} is {row[name]} instead of {value}")
            else:
                near(f"order {row['order']:g}, level {row['level']:g}: {name}", row[name], value, absolute=tolerance(reference, name, relative))


def inside(run, quantity, value):
    """Whether a known value lies within the error bar, and that the bar says something."""
    told = block(run)["richardson"][quantity]
    near(quantity, told["value"], value, absolute=told["uncertainty"])
