"""Bodies coloured by their temperature, as the file has it: that of the formula, 0 in a body without one."""
import numpy as np

from canvas import load, require_tidy, words_of
from judge import near, require


def judge(run):
    other = run.again("-hub_temperature", "0-100-x", "-units", "mm,N,MPa,K", name="formula")
    plot, prefix = load(), str(other.folder / "result")
    with other.fields() as file:
        points, temperature, body, cells = (file[name][()] for name in ("points", "temperature", "body", "cells"))
    blocks = plot.read_cells(cells)
    owner = {node: int(b) for block, owners in zip(blocks, np.split(body, np.cumsum([len(block) for block in blocks])[:-1]))
             for nodes, b in zip(block, owners) for node in nodes}
    near("temperature", temperature, [-100 - x if owner[node] == 0 else 0 for node, x in enumerate(points[:, 0])], absolute=1e-12)
    for units, name in ((None, "temperature (K)"), ("mm,N,MPa,°C", "temperature (°C)"), ("mm,N,MPa", "temperature")):
        summary = plot.open_summary(prefix, units)
        figure = plot.draw_solved(prefix, summary, None, "temperature")
        require_tidy(figure, name)
        found = [text for text, _ in words_of(figure) if text.startswith("temperature")]
        require(len(found) == 1 and found[0].split(" (largest")[0] == name, f"{name} is {found}")
