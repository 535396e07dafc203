"""Tables of -paths: places, exact displacements and stresses inside the body, empty cells outside; and their graphs."""
import csv
import math

import numpy as np

from canvas import load, require_tidy, words_of
from judge import near, require, same

P, E, NU = 1e6, 1e9, 0.3  # the pressure of both patch tests, and the upper block


def exact(dim, at):
    """Displacement, stress and von Mises stress of the upper block: squeezed along the last axis, free across; plane strain, or space."""
    if dim == 2:
        u = [NU * (1 + NU) * P / E * at[0], -1.37875e-3 + (1 - at[1]) * (1 - NU ** 2) * P / E]
        return [*u, 0, -P, -NU * P, 0, 0, 0, P * math.sqrt(1 - NU + NU ** 2)]
    u = [NU * P / E * at[0], NU * P / E * at[1], -1.5e-3 + (1 - at[2]) * P / E]
    return [*u, 0, 0, -P, 0, 0, 0, P]


def judge(run):
    dim, given = run.summary["scene"]["dimension"], run.summary["options"]
    axes = "xyz"[:dim]
    with open(run.folder / "result_paths.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    values = [*(f"u{axis}" for axis in axes), "xx", "yy", "zz", "yz", "xz", "xy", "von_mises"]
    same("columns", list(rows[0]), ["path", "length", *axes, *values])
    for name in given["paths"].split(","):
        own = [row for row in rows if row["path"] == name]
        begin, end = (np.array([float(x) for x in given[f"path_{name}_{which}"].split(",")]) for which in ("from", "to"))
        number = int(given.get(f"path_{name}_points", 51))
        same(f"points of {name}", len(own), number)
        outside = 0
        for i, row in enumerate(own):
            at = begin + i / (number - 1) * (end - begin)
            near("place", [float(row[axis]) for axis in axes], at, absolute=1e-14)
            near("length", float(row["length"]), i / (number - 1) * np.linalg.norm(end - begin), absolute=1e-14)
            if at[-1] < -1e-9:  # below the upper block
                same("cells outside", {row[value] for value in values}, {""})
                outside += 1
                continue
            want = exact(dim, at)
            near("displacement", [float(row[value]) for value in values[:dim]], want[:dim], absolute=1e-12)
            near("stress", [float(row[value]) for value in values[dim:]], want[dim:], absolute=1e-6 * P)
        same(f"points of {name} outside", outside, {"down": 3, "slant": 0, "line": 1}[name])

    plot = load()
    figure = load("mortise-plot-paths").draw(plot, str(run.folder / "result"), plot.open_summary(str(run.folder / "result"), "mm,N,MPa"))
    require_tidy(figure, "paths")
    words = [text for text, _ in words_of(figure)]
    for name in given["paths"].split(","):
        require(any(word.startswith(f"{name}: ") for word in words), f"no graph of {name}: {words}")
    require("stress (MPa)" in words and "length along the path (mm)" in words, f"no units: {words}")
    shown = {line.get_label(): line.get_ydata() for line in figure.axes[0].get_lines()}
    near("von Mises in the graph", np.nanmax(shown["von Mises"]), exact(dim, [0] * dim)[-1], relative=1e-6)
    require("yz" not in shown, "the graph has a line of zeros")
