"""A run in another format than the one before removes the earlier fields, picture and page. Other files and folders of such names stay."""
import pathlib
import subprocess

from judge import CHECKS, NAME, require, same

PLOT = pathlib.Path(__file__).parents[2] / "src" / "plot" / "mortise-plot"


def endings(run, *arguments):
    done = subprocess.run([run.program, *CHECKS, "-output", NAME, *run.arguments, *arguments], cwd=run.folder, capture_output=True, text=True, check=False)
    require(done.returncode == 0, f"exit code {done.returncode}: {done.stderr}")
    return sorted({file.suffix for file in run.folder.iterdir() if file.is_file()})


def judge(run):
    same("files of VTU alone", endings(run, "-output_format", "vtu"), [".csv", ".json", ".vtu"])
    (run.folder / f"{NAME}.h5").mkdir()
    same("files beside a folder", endings(run, "-output_format", "vtu"), [".csv", ".json", ".vtu"])
    (run.folder / f"{NAME}.h5").rmdir()
    same("files of XDMF again", endings(run), [".csv", ".h5", ".json", ".xdmf"])
    same("files with a page", endings(run, "-report"), [".csv", ".h5", ".html", ".json", ".xdmf"])
    subprocess.run([PLOT, run.folder / NAME], check=True, capture_output=True)
    picture = (run.folder / f"{NAME}.png").read_bytes()
    same("files with the next page", endings(run, "-report"), [".csv", ".h5", ".html", ".json", ".xdmf"])
    (run.folder / f"{NAME}.png").write_bytes(picture)
    same("files after both", endings(run), [".csv", ".h5", ".json", ".xdmf"])
    (run.folder / f"{NAME}.png").write_bytes(bytes(range(256)))
    (run.folder / f"{NAME}.html").write_text("a page of somebody")
    same("files beside those of others", endings(run), [".csv", ".h5", ".html", ".json", ".png", ".xdmf"])
