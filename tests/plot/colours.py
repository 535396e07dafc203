"""Colours of bodies by any field. What is drawn is what the file has; a name that it does not have is answered by those that it has."""

import numpy as np

from canvas import load, require_tidy, told, words_of
from judge import near, require, same


def judge(run):
    plot, prefix = load(), str(run.folder / "result")
    summary = plot.open_summary(prefix, "mm,N,MPa")
    with run.fields() as file:
        points, stress, status, gap, body, cells = (file[name][()] for name in ("points", "stress", "status", "gap", "body", "cells"))
    shear = plot.read_fields(prefix, "stress:xy", summary)
    near("stress:xy", shear["colour"], stress[:, 1], relative=1e-15)
    same("its name", shear["colour_name"], "stress xy (MPa)")
    side = plot.read_fields(prefix, "gap", summary)
    same("nodes with a gap", np.flatnonzero(np.isfinite(side["colour"])).tolist(), np.flatnonzero((status >= 0) & np.isfinite(gap)).tolist())
    same("its name", side["colour_name"], "gap (mm)")
    number = plot.read_fields(prefix, "body", summary)["colour"]
    for which in np.unique(body):
        blocks = plot.read_cells(cells)
        nodes = np.unique(np.concatenate([b[o == which].ravel() for b, o in zip(blocks, np.split(body, np.cumsum([len(b) for b in blocks])[:-1]))]))
        near("number of the body at its nodes", number[nodes], [which] * len(nodes), absolute=0)
    for colour in ("gap", "pressure", "stress:xy", "body", "first", "displacement"):
        figure = plot.draw_solved(prefix, summary, None, colour)
        require_tidy(figure, colour)
        require(any(plot.read_fields(prefix, colour, summary)["colour_name"] in text for text, _ in words_of(figure)), f"{colour} has no name")
    require(len(points) == len(number), "colours are not those of nodes")
    for colour, says in (("tempreature", "has no tempreature; there are von_mises"), ("stress", "stress:xx"), ("gap:x", "has no components"),
                         ("displacement:q", "the components of displacement are x, y")):
        code, words = told(plot, prefix, "--colour", colour, "-o", run.folder / "none.png")
        same(f"exit code of --colour {colour}", code, 1)
        require(f"--colour {colour}: " in words and says in words and words.count("\n") == 1, words)
        require(not (run.folder / "none.png").exists(), "there is a picture of a mistake")
