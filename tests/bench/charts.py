"""Charts of what scaling.py measured: cost.svg, shares.svg, accuracy.svg."""
import os

from cases import SCENES
from figures import STAGES, exponents, of_scene, share


def draw(found, folder):
    import matplotlib  # pylint: disable=import-outside-toplevel

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "mortise"
    import matplotlib.pyplot as plt  # pylint: disable=import-outside-toplevel

    scenes = {name: of_scene(found, name) for name in SCENES}
    scenes = {name: rows for name, rows in scenes.items() if rows}

    def finish(figure, file):
        figure.tight_layout()
        figure.savefig(os.path.join(folder, file), metadata={"Date": None})
        plt.close(figure)

    cost_chart(plt, found, scenes, finish)
    share_chart(plt, scenes, finish)
    if found["accuracy"]:
        accuracy_chart(plt, found, finish)


def cost_chart(plt, found, scenes, finish):
    growth = {name: (least, most, exponent) for name, least, most, exponent in exponents(found)}
    figure, (cost, ratio) = plt.subplots(1, 2, figsize=(13, 4.5))
    for colour, (name, rows) in enumerate(scenes.items()):
        size = [row["unknowns"] for row in rows]
        label = SCENES[name].words + (f", to the {growth[name][2]:.2f}" if name in growth else "")
        cost.loglog(size, [row["cpu"] for row in rows], "o", color=f"C{colour}", label=label)
        if name in growth:
            least, most, exponent = growth[name]
            points = [row for row in rows if row["unknowns"] >= least]
            middle = [(row["unknowns"], row["cpu"]) for row in points]
            scale = 1
            for n, seconds in middle:
                scale *= (seconds / n**exponent) ** (1 / len(middle))
            cost.loglog([least, most], [scale * least**exponent, scale * most**exponent], "-", color=f"C{colour}")
        measured = [row for row in rows if row["ratio"]]
        ratio.semilogx([row["unknowns"] for row in measured], [row["ratio"] for row in measured], "o-", color=f"C{colour}")
    cost.set(xlabel="unknowns", ylabel="CPU seconds, whole program")
    ratio.set(xlabel="unknowns", ylabel="contact solve / one linear solve", ylim=(0, None))
    for axes in (cost, ratio):
        axes.grid(True, which="both", alpha=0.3)
    ratio.legend(*cost.get_legend_handles_labels(), fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5), title="time grows as size")
    finish(figure, "cost.svg")


def share_chart(plt, scenes, finish):
    figure, axes = plt.subplots(figsize=(8, 0.7 + 0.5 * len(scenes) + 0.8))
    for place, rows in enumerate(scenes.values()):
        left = 0
        for colour, stage in enumerate(STAGES):
            part = share(rows[-1], stage)
            axes.barh(place, part, left=left, color=f"C{colour}", label=None if place else stage)
            left += part
    axes.set_yticks(range(len(scenes)), [f"{SCENES[name].words}\n{rows[-1]['unknowns']} unknowns" for name, rows in scenes.items()], fontsize=8)
    axes.set(xlabel="% of the wall clock", xlim=(0, 100))
    axes.legend(fontsize=8, ncol=len(STAGES), loc="lower center", bbox_to_anchor=(0.5, 1))
    finish(figure, "shares.svg")


def accuracy_chart(plt, found, finish):
    figure, axes = plt.subplots(figsize=(6.5, 4.5))
    kinds = sorted({(row["order"], row["solver"]) for row in found["accuracy"]})
    for order, solver in kinds:
        rows = [row for row in found["accuracy"] if (row["order"], row["solver"]) == (order, solver)]
        axes.loglog([row["cpu"] for row in rows], [row["error"] for row in rows], "o-" if solver == "multigrid" else "s--", color=f"C{order}",
                    label=f"order {order}, {solver}")
    axes.set(xlabel="CPU seconds, whole program, coarser meshes left out", ylabel="relative error in the energy norm")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend(fontsize=8)
    finish(figure, "accuracy.svg")
