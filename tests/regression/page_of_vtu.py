"""A page of solids whose fields are in VTU files, which nothing here draws: all its tables, and a sentence where pictures would be."""
from judge import require


def judge(run):
    page = (run.folder / "result.html").read_text(encoding="utf-8")
    require("No picture of the bodies" in page, "the page does not say why there is no picture")
    require("largest pressure" in page.lower(), "the page lost its tables")
