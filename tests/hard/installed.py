"""The installed program beside its installed companions: a page, and a picture of the same run."""
import pathlib
import subprocess

from judge import require, same


def judge(run):
    page = (run.folder / "result.html").read_text(encoding="utf-8")
    require("Flat punch" in page and "data:image/svg+xml" in page, "the page has no title or no picture")
    plot = pathlib.Path(run.program).parent / "mortise-plot"
    same("exit code of mortise-plot", subprocess.run([plot, run.folder / "result"], check=False).returncode, 0)
    require((run.folder / "result.png").stat().st_size > 0, "there is no picture")
