"""Tables of what scaling.py measured, and whether it is what was aimed at."""
import math
import statistics

from cases import SCENES

SMALL, LARGE = 1e4, 9e5  # unknowns between which figures are aimed at, about
STAGES = ["setup", "mortar", "assembly", "condense", "solve", "output"]


PICTURES = """
![CPU seconds against unknowns, and contact over one linear solve](cost.svg)
![Shares of the stages](shares.svg)
![Error against CPU seconds](accuracy.svg)
"""


def number(value, digits=0):
    return "-" if value is None else f"{value:.{digits}f}"


def markdown(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|---|" + "---:|" * (len(header) - 1)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


def of_scene(found, name, least=0, most=math.inf):
    """Rows of a scene from smaller to larger."""
    rows = [row for row in found["rows"] if row["scene"] == name and least <= row["unknowns"] <= most]
    return sorted(rows, key=lambda row: row["unknowns"])


def slope(rows):
    """Exponent of CPU seconds against unknowns, by least squares of the logarithms; None of fewer than two sizes."""
    points = [(math.log(row["unknowns"]), math.log(row["cpu"])) for row in rows]
    if len(points) < 2:
        return None
    x, y = (statistics.mean(values) for values in zip(*points))
    return sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)


def exponents(found):
    """(scene, smallest, largest, exponent) of the sizes that count for it."""
    for name, scene in SCENES.items():
        large = of_scene(found, name, scene.slope_from)
        if len(large) > 1:
            yield name, large[0]["unknowns"], large[-1]["unknowns"], slope(large)


def share(row, stage):
    return 100 * row["seconds"][stage] / row["wall"]


def cost_table(found):
    header = ["scene", "size", "unknowns", "runs", "CPU s", "MB", "steps", "CG", "CG, one solve", "work units", "of one solve", "contact / linear",
              "work, discretisation"] + [f"{stage} s" for stage in STAGES] + ["mortar %"]
    rows = []
    for row in found["rows"]:
        rows.append([SCENES[row["scene"]].words, row["size"], row["unknowns"], row["runs"], number(row["cpu"], 2), number(row["megabytes"]), row["steps"],
                     row["iterations"], number(row["one_iterations"]), number(row["work"]), number(row["one_work"]), number(row["ratio"], 2),
                     number(row.get("stopped_work"))] + [number(row["seconds"][stage], 2) for stage in STAGES] + [number(share(row, "mortar"), 1)])
    return markdown(header, rows)


def rank_table(found):
    header = ["scene", "unknowns", "ranks", "steps", "CG", "work units", "wall s", "CPU s", "times as fast", "at most", "MB",
              "MB, largest rank"]
    rows = []
    for row in found["ranks"]:
        alone = next((r for r in found["ranks"] if (r["scene"], r["size"], r["ranks"], r["timed"]) == (row["scene"], row["size"], 1, row["timed"])), row)
        timed = row["timed"]
        rows.append([SCENES[row["scene"]].words, row["unknowns"], row["ranks"], row["steps"], row["iterations"], number(row["work"], 1),
                     number(row["wall"] if timed else None, 2), number(row["cpu"] if timed else None, 2),
                     number(alone["wall"] / row["wall"] if timed else None, 2),
                     number(2 * alone["wall"] / alone["beside"] if row["ranks"] == 2 and alone.get("beside") else None, 2), number(row["megabytes"]),
                     number(row["largest"])])
    return markdown(header, rows)


def accuracy_table(found):
    header = ["order, solver", "unknowns", "relative error", "CPU s", "MB"]
    rows = [[f"{row['order']}, {row['solver']}", row["unknowns"], f"{row['error']:.1e}", number(row["cpu"], 2), number(row["megabytes"])]
            for row in sorted(found["accuracy"], key=lambda row: (row["order"], row["solver"], row["unknowns"]))]
    return markdown(header, rows)


def cross_table(found):
    pairs = {"steps": ("steps", 0), "work units": ("work", 0), "CPU s": ("cpu", 2), "MB": ("megabytes", 0)}
    header = ["scene", "unknowns", *(f"{word}, {who}" for word in list(pairs)[:2] for who in ("first", "second")),
              *(f"{word}, {what}" for word in list(pairs)[2:] for what in ("first", "both")),
              "largest difference of displacements", "differently active"]
    return markdown(header, [[SCENES[row["scene"]].words, row["unknowns"],
                              *(number(value, digits) for key, digits in pairs.values() for value in row.get(key, (None, None))),
                              f"{row['difference']:.1e}", row["active"]] for row in found["cross"]])


def files_table(found):
    """Of runs that were measured before there was this part, nothing."""
    rows = [[f"{row['order']}, {row['solver']}", row["unknowns"], row["steps"], number(row["iterations"]), number(row["work"]), number(row["cpu"], 2),
             number(row["megabytes"])] for row in found.get("files", [])]
    return markdown(["ball on block, Gmsh tetrahedra: order, solver", "unknowns", "steps", "CG", "work units", "CPU s", "MB"], rows) if rows else ""


class Verdicts:
    """Figures, what they are to be, and whether they are."""

    def __init__(self, found):
        self.found, self.rows = found, []

    def add(self, words, aim, value, limit, digits=2, least=False):
        met = "not measured" if value is None else "yes" if (value >= limit if least else value <= limit) else "**no**"
        self.rows.append([words, aim, number(value, digits), met])

    def largest(self, key, names, least=0, most=math.inf):
        values = [key(row) for name in names for row in of_scene(self.found, name, least, most)]
        return max((value for value in values if value is not None), default=None)

    def speed(self, scene):
        walls = {row["ranks"]: row["wall"] for row in self.found["ranks"] if row["scene"] == scene and row["timed"]}
        return walls[1] / walls[2] if 1 in walls and 2 in walls else None


def verdicts(found):
    plane, solid = (["plates", "squares", "hertz2d"], ["blocks", "hertz3d"])
    v = Verdicts(found)
    growth = {name: exponent for name, _, most, exponent in exponents(found) if most > LARGE}
    v.add("CG iterations to 1e-8 of one linear solve, plates and blocks", "<= 10", v.largest(lambda r: r["one_iterations"], ["plates", "squares", "blocks"], SMALL), 10, 0)
    v.add("the same, hertz2d and hertz3d", "<= 10", v.largest(lambda r: r["one_iterations"], ["hertz2d", "hertz3d"], SMALL), 10, 0)
    v.add("steps on the finest level", "<= 2", v.largest(lambda r: r["steps"], plane + solid, SMALL), 2, 0)
    v.add("contact / linear, two plates, 1e6", "<= 1.5", v.largest(lambda r: r["ratio"], ["plates"], LARGE), 1.5)
    v.add("contact / linear, two blocks, 3e5", "<= 1.6", v.largest(lambda r: r["ratio"], ["blocks"], 2e5, 4e5), 1.6)
    for least, seconds, megabytes in ((2e5, 3, 450), (LARGE, 12, 1.6 * 1024)):
        v.add(f"two plates 1 : 1, {'264k' if least < LARGE else '1.05e6'}: CPU s", f"<= {seconds}", v.largest(lambda r: r["cpu"], ["squares"], least, 3 * least), seconds)
        v.add(f"two plates 1 : 1, {'264k' if least < LARGE else '1.05e6'}: MB", f"<= {megabytes:.0f}", v.largest(lambda r: r["megabytes"], ["squares"], least, 3 * least), megabytes, 0)
    v.add("two blocks, 315k: CPU s", "<= 15", v.largest(lambda r: r["cpu"], ["blocks"], 2e5, 4e5), 15)
    v.add("two blocks, 315k: MB", "<= 1229", v.largest(lambda r: r["megabytes"], ["blocks"], 2e5, 4e5), 1229, 0)
    v.add("two blocks, 1e6: CPU s", "<= 60", v.largest(lambda r: r["cpu"], ["blocks"], LARGE), 60)
    v.add("work units of the whole solve, meshes with levels", "<= 200", v.largest(lambda r: r["work"], plane + solid, SMALL), 200, 0)
    v.add("the same, meshes with one level", "<= 200", v.largest(lambda r: r["work"], ["tets"]), 200, 0)
    v.add("with -stop discretisation", "<= 60", v.largest(lambda r: r.get("stopped_work"), plane + solid, SMALL), 60, 0)
    v.add("exponent of CPU s, two plates 9 : 7", "<= 1.1", growth.get("plates"), 1.1)
    v.add("exponent of CPU s, two blocks", "<= 1.15", growth.get("blocks"), 1.15)
    v.add("mortar, % of the total, plane", "<= 5", v.largest(lambda r: share(r, "mortar"), plane, 1e5), 5, 1)
    v.add("mortar, % of the total, space", "<= 10", v.largest(lambda r: share(r, "mortar"), solid, 4e4), 10, 1)
    v.add("two ranks against one, two plates, 1e6", ">= 1.7", v.speed("plates"), 1.7, least=True)
    v.add("two ranks against one, two blocks, 3e5", ">= 1.7", v.speed("blocks"), 1.7, least=True)
    for name in ("plates", "blocks", "hertz3d"):
        rows = [row for row in found["ranks"] if row["scene"] == name and not row["timed"]]
        spread = max(r["iterations"] for r in rows) - min(r["iterations"] for r in rows) if rows else None
        v.add(f"CG, most less fewest on 1 to {max((r['ranks'] for r in rows), default=0)} ranks, {SCENES[name].words}", "<= 1", spread, 1, 0)
    v.add("the two solvers differ by, largest, relative / 1e-8", "<= 1", max((row["difference"] / 1e-8 for row in found["cross"]), default=None), 1, 4)
    return markdown(["figure", "aim", "measured", "met"], v.rows)


def growth_lines(found):
    return "".join(f"* {SCENES[name].words}: CPU seconds grow with unknowns to the {exponent:.2f}, from {least} to {most}\n"
                   for name, least, most, exponent in exponents(found))


def origin(found):
    extra = f", with {' '.join(found['options'])}" if found["options"] else ""
    return (f"{found['machine']}, {found['date']}, {'one run' if found['quick'] else 'medians of the number of runs that is told'}{extra}; "
            f"load of the machine at the beginning {found['load'][0]:.1f}, at the end {found['load'][1]:.1f}.\n")


def sections(found):
    """Texts by the names of their places in a README."""
    return {
        "figures": origin(found) + "\n" + verdicts(found),
        "tables": "\n".join([origin(found), verdicts(found), cost_table(found), growth_lines(found) + PICTURES, rank_table(found), cross_table(found),
                             accuracy_table(found), files_table(found)]),
    }
