"""The page of -report: it stands alone, it escapes what users write, its pictures are pictures, its numbers are the summary's."""
import base64
import html.parser
import os
import xml.etree.ElementTree as xml

from judge import Run, near, require, same

TITLE = """<script>alert('a')</script> & "b" </title>"""
VOID = {"meta", "img", "br", "hr", "link", "input"}
BLOCK = """import sys
class Block:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] == "h5py":
            raise ModuleNotFoundError("No module named 'h5py'", name="h5py")
sys.meta_path.insert(0, Block())
"""
BREAK = """raise RuntimeError("the disk burns")\n"""


class Page(html.parser.HTMLParser):
    """The page by parts: tags with their attributes, all text, and the numbers and words of every row of a table."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.open, self.words, self.rows, self.datum = [], [], "", [], None
        self.feed(text)
        self.close()
        require(not self.open, f"left open: {self.open}")

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)
        if tag == "tr":
            self.rows.append({"words": "", "numbers": [], "read": []})
        if tag == "data":
            self.datum = [dict(attrs)["value"], ""]
        if tag == "sup":
            self.handle_data("^")

    def handle_endtag(self, tag):
        require(self.open and self.open.pop() == tag, f"</{tag}> closes what is not open")
        if tag == "data" and "tr" in self.open:
            self.rows[-1]["numbers"].append(float(self.datum[0]))
            self.rows[-1]["read"].append(self.datum[1])
        if tag == "data":
            self.datum = None

    def handle_data(self, data):
        self.words += data
        if "tr" in self.open:
            self.rows[-1]["words"] += data
        if self.datum:
            self.datum[1] += data


def read(number):
    """'−1.5 × 10^6', '10^-6', '4 096' (with narrow blanks) as a number, and what its last digit leaves open."""
    number = number.replace("\u2212", "-").replace("\u202f", "")
    mantissa, _, power = number.replace("×10^", "e").partition("e")
    if "10^" in mantissa:
        sign, _, power = mantissa.partition("10^")
        mantissa = sign + "1"
    open_digits = 10.0 ** -len(mantissa.partition(".")[2])
    return float(mantissa) * 10.0 ** int(power or 0), 0.5 * open_digits * 10.0 ** int(power or 0)


def leaves(tree):
    """All numbers of nested dictionaries and lists."""
    if isinstance(tree, (dict, list)):
        for part in tree.values() if isinstance(tree, dict) else tree:
            yield from leaves(part)
    elif isinstance(tree, float | int):
        yield tree


def judge_digits(page, bars, others):
    """What is read is what the machine reads, rounded; only beside larger ones in its row a number may be read as 0. Error bars are
    rounded up, and have the rounding of their value in them. A number may be the value of a bar by chance, as a place on a mesh is."""
    for row in page.rows:
        largest = max(map(abs, row["numbers"]), default=0.0)
        for value, shown in zip(row["numbers"], row["read"]):
            near_by, allowed = read(shown)
            if value in bars and not (value in others and abs(near_by - value) <= 1.001 * allowed):
                require(value <= near_by <= value + 3.001 * allowed, f"the error bar {value} is read as {shown}")
                continue
            require(abs(near_by - value) <= (1e-12 * largest if shown == "0" else 1.001 * allowed), f"{value} is read as {shown}")


def judge_alone(page, text):
    """Nothing comes from elsewhere, nothing runs."""
    for tag, attributes in page.tags:
        require(tag not in ("script", "link", "iframe", "object", "embed", "base"), f"the page has a <{tag}>")
        for name, value in attributes.items():
            require(not name.startswith("on"), f"<{tag} {name}> runs a script")
            if name in ("src", "href", "srcset", "data", "poster", "action"):
                require(value.startswith(("data:", "#")), f"<{tag} {name}={value[:60]}> comes from elsewhere")
    require("url(" not in text and "@import" not in text, "the style comes from elsewhere")
    require(text.startswith("<!DOCTYPE html>"), "the page does not say that it is HTML")
    same("tables have rows", any(tag == "tr" for tag, _ in page.tags), True)


def judge_pictures(page, count):
    images = [attributes for tag, attributes in page.tags if tag == "img"]
    same("pictures", len(images), count)
    for attributes in images:
        kind, data = attributes["src"].split(";base64,")
        same("kind of picture", kind, "data:image/svg+xml")
        require(attributes["alt"], "a picture says nothing to who cannot see it")
        picture = xml.fromstring(base64.b64decode(data, validate=True))
        require(picture.tag.endswith("svg") and len(list(picture.iter())) > 20, "a picture is empty")
        for element in picture.iter():
            for name, value in element.attrib.items():
                require(not name.endswith("href") or value.startswith(("data:", "#")), f"a picture takes {value[:60]} from elsewhere")


def judge_numbers(page, summary):
    """The rows of the tables against the summary, digit by digit."""

    def told(first, *numbers):
        rows = [row["numbers"] for row in page.rows if row["words"].startswith(first)]
        require([float(number) for number in numbers] in rows, f"no row of {first} has {numbers}, but {rows}")

    limit, solver = summary["solver"]["certificate_limit"], summary["solver"]
    for name, pair in summary["pairs"].items():
        told(name, *pair["force"], pair["normal_force"], pair["area"], pair["active_nodes"], summary["scene"]["pairs"][name]["candidates"], pair["min_gap"])
        told(name, pair["max_pressure"], *pair["max_pressure_at"], *pair["centre_of_pressure"], *pair["extent"]["lower"], *pair["extent"]["upper"])
    for side, force in summary["reactions"].items():
        told(side, *force)
    for name, probe in summary["probes"].items():
        told(name, *probe["at"], *probe["displacement"], probe["von_mises"])
        told(name, *probe["stress"])
    for name, value in summary["energy"]["strain"].items():
        told(f"strain energy of {name}", value)
    told("potential energy", summary["energy"]["potential"])
    told("equilibrium", solver["kkt"]["equilibrium"], limit)
    told("distance from the exact solution", solver["energy_bound"]["relative"])
    told("balance of moments", solver["balance"]["moment"], limit)
    told("total", summary["timing"]["total"])
    for name, body in summary["scene"]["bodies"].items():
        told(name, *(body[key] for key in ("order", "cells", "nodes", "dofs")))


def judge_study(page, study):
    """Every run of a study, and what is extrapolated."""
    rows = [row["numbers"] for row in page.rows]
    for run in study["runs"]:
        start = [float(run[key]) for key in ("order", "level", "cells", "unknowns", "h")]
        found = [row for row in rows if row[:len(start)] == start]
        require(found, f"there is no row of order {run['order']}, level {run['level']}")
        rates = [run[key] for key in ("energy_error_relative", "energy_error_rate", "l2_error_relative", "l2_error_rate") if run[key] is not None]
        same("errors and rates", found[0][len(start):len(start) + len(rates)], rates)
        same("seconds", found[0][-3:-1], [run["seconds_total"], run["seconds_with_coarser"]])
    for name, quantity in study["richardson"].items():
        if "text" not in quantity:  # a component that the scene does not have
            near(name, quantity["value"], 0, absolute=1e-9)
            continue
        require([quantity["value"], quantity["uncertainty"], quantity["order"]] in rows, f"the extrapolated {name} is not in the page")


def judge_failed(run, arguments):
    """A run that is not solved has its page, which says so on top."""
    failed = Run(run.program, run.mpiexec, run.ranks, run.folder / "failed", arguments + ["-ksp_type", "cg", "-pc_type", "jacobi", "-ksp_max_it", "1"])
    same("exit code", failed.exit, 3)
    page = Page((failed.folder / "result.html").read_text())
    body = page.words[page.words.index("NOT SOLVED"):]
    require(page.words.index("NOT SOLVED") < page.words.index("Contact analysis"), "the failure does not stand on top")
    require("they are no solution" in body, "the page does not warn of its numbers")


def with_module(run, name, module, code, arguments):
    """A run whose companion meets a module of ours before the system's."""
    folder = run.folder / f"{name}_modules"
    folder.mkdir()
    (folder / f"{module}.py").write_text(code)
    before = os.environ.get("PYTHONPATH")
    os.environ["PYTHONPATH"] = str(folder)
    try:
        return Run(run.program, run.mpiexec, run.ranks, run.folder / name, arguments)
    finally:
        if before is None:
            del os.environ["PYTHONPATH"]
        else:
            os.environ["PYTHONPATH"] = before


def judge_without(run, arguments):
    """What the companion lacks is told before anything is computed; what goes wrong afterwards costs the page alone."""
    lacking = with_module(run, "lacking", "sitecustomize", BLOCK, arguments)
    same("exit code without h5py", lacking.exit, 1)
    require("-report: mortise-report: h5py is missing (Debian: apt install python3-h5py)" in lacking.stderr, f"it says {lacking.stderr}")
    same("files without h5py", list(lacking.folder.iterdir()), [])
    broken = with_module(run, "broken", "matplotlib", BREAK, arguments)
    same("exit code of a companion that fails", broken.exit, 4)
    require("the disk burns" in broken.stderr and "all other results are complete" in broken.stderr, f"it says {broken.stderr}")
    same("status of a companion that fails", broken.summary["status"], "solved")
    require(not (broken.folder / "result.html").exists(), "there is a page of a companion that failed")


def judge(run):
    text = (run.folder / "result.html").read_text(encoding="utf-8")
    page = Page(text)
    judge_alone(page, text)
    require(TITLE in page.words, "the title is not what was given")
    judge_pictures(page, 1 + len(run.summary["pairs"]) + ("study" in run.summary))
    judge_numbers(page, run.summary)
    judge_digits(page, [quantity["uncertainty"] for quantity in run.summary.get("study", {}).get("richardson", {}).values()]
                 + list(leaves(run.summary.get("bars") or {})), set(leaves(run.summary["pairs"])))
    if "study" in run.summary:
        judge_study(page, run.summary["study"])
        return
    judge_failed(run, run.arguments)
    judge_without(run, run.arguments)
