"""The page of an adaptive run: its estimated error, each number with its bar, rounded up, and a row for each mesh."""
import html
import re

from judge import near, require, same


def numbers(row):
    """Values in the machine's form and as they are read."""
    return [(float(value), read) for value, read in re.findall(r'<data value="([^"]*)">(.*?)</data>', row)]


def rows_of(page):
    return [(html.unescape(re.sub("<[^>]*>", " ", row)), numbers(row)) for row in re.findall("<tr.*?</tr>", page, re.DOTALL)]


def read(text):
    mantissa, _, power = text.replace("\u202f", "").replace("\u2212", "-").replace("×", "").partition("10<sup>")
    return float(mantissa or 1) * 10.0 ** int(power.partition("<")[0] or 0) if power else float(mantissa)


def judge(run):
    page, summary = (run.folder / "result.html").read_text(encoding="utf-8"), run.summary
    page = page[page.index("Error of the mesh"):]
    relative = float(re.search(r'energy norm: <data value="([^"]*)">', page)[1])
    near("estimated error", relative, 100 * summary["estimate"]["energy_norm_relative"], relative=1e-12)
    rows = rows_of(page)
    for key in ("normal_force", "area", "mean_pressure"):
        value, bar = summary["pairs"]["joint"][key], summary["bars"]["pairs"]["joint"][key]
        found = [row for words, row in rows if f"pair, joint, {key.replace('_', ' ')}" in words]
        same(f"rows of {key}", [[number for number, _ in row] for row in found], [[value, bar]])
        require(bar <= read(found[0][1][1]) <= 1.1 * bar, f"the bar {bar} is read as {found[0][1][1]}")
    potential = [[number for number, _ in row] for words, row in rows if "energy, potential" in words]
    same("energy", potential, [[summary["energy"]["potential"], summary["bars"]["energy"]["potential"]]])
    meshes = [[number for number, _ in row] for _, row in rows_of(page[page.index("Meshes, the last one"):]) if len(row) == 6]
    for index, mesh in enumerate(summary["estimate"]["meshes"], 1):
        same(f"mesh {index}", meshes[index - 1][:3], [float(index), float(mesh["cells"]), float(mesh["unknowns"])])
