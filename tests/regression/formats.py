"""A run in another format than the one before: fields of the earlier one go with its summary, and a folder of such a name stays."""
import subprocess

from judge import CHECKS, NAME, require, same


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
