"""Groups of one name are one group: the pressure 1 acts on all of a block of width 2, on the file and on what -convert makes of it."""
import subprocess

from judge import near, require


def judge(run):
    converted = run.folder / "names.h5"
    made = subprocess.run([run.program, "-convert", "names.msh", str(converted)], cwd=__file__.rpartition("/")[0], capture_output=True, text=True, check=False)
    require(made.returncode == 0, f"-convert: exit code {made.returncode}: {made.stderr}")
    for done in (run, run.again("-block_dm_plex_filename", str(converted), name="converted")):
        near("load", done.summary["loads"]["block:top side"]["force"], [0, -2], relative=1e-12)
        near("force", done.pair("floor")["force"], [0, 2], relative=1e-9)
        near("area", done.pair("floor")["area"], 2, relative=1e-9)
