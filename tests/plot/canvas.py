"""Figures of the companions, and what is drawn in them: words and where they stand."""
import contextlib
import importlib.machinery
import importlib.util
import io
import pathlib
import sys

from matplotlib.text import Text

from judge import require

PLOT = pathlib.Path(__file__).parents[2] / "src" / "plot"


def load(name="mortise-plot"):
    """A companion as a module."""
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader(name.replace("-", "_"), str(PLOT / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    sys.modules[loader.name] = module
    loader.exec_module(module)
    return module


def told(plot, *arguments):
    """(exit code, stderr) of a companion that is loaded already: another process would import matplotlib again, for a second."""
    words, before = io.StringIO(), sys.argv
    sys.argv = [plot.__name__, *map(str, arguments)]
    try:
        with contextlib.redirect_stderr(words):
            code = plot.main()
    except SystemExit as end:  # of argparse
        code = end.code
    finally:
        sys.argv = before
    return code, words.getvalue()


def not_drawn(figure):
    """Texts that matplotlib keeps but does not draw: numbers beyond the ends of an axis, and all of axes that are off."""
    hidden = []
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            margin = 1e-9 * (high - low)
            ticks = [tick for which in (axis.get_major_ticks(), axis.get_minor_ticks()) for tick in which]
            hidden += [text for tick in ticks for text in (tick.label1, tick.label2)
                       if not axes.axison or not text.get_visible() or not low - margin <= tick.get_loc() <= high + margin]
            hidden += [] if axes.axison else [axis.label, axis.offsetText]
    return set(map(id, hidden))


def words_of(figure):
    """Every text that is drawn, with its box in pixels: [(text, box)]."""
    figure.draw_without_rendering()
    hidden = not_drawn(figure)
    return [(part.get_text(), part.get_window_extent()) for part in figure.findobj(Text)
            if part.get_text().strip() and part.get_visible() and id(part) not in hidden]


def require_tidy(figure, name):
    """No words are cut by the edge of the picture, and none stand on others."""
    found, canvas = words_of(figure), figure.bbox
    for text, box in found:
        inside = box.x0 >= canvas.x0 - 1 and box.y0 >= canvas.y0 - 1 and box.x1 <= canvas.x1 + 1 and box.y1 <= canvas.y1 + 1
        require(inside, f"{name}: '{text}' at {box.extents.round()} is cut by the edge of the picture, {canvas.extents}")
    for i, (text, box) in enumerate(found):
        for other, second in found[i + 1:]:
            across = min(box.x1, second.x1) - max(box.x0, second.x0)
            along = min(box.y1, second.y1) - max(box.y0, second.y0)
            require(across <= 1 or along <= 1, f"{name}: '{text}' and '{other}' overlap by {across:.1f} by {along:.1f} pixels")
