"""What the checks of this folder share: runs that come to an untimely end, and what they may leave."""
import os
import pathlib
import signal
import subprocess
import time

from judge import ALONE, NAME, TIMEOUT, require

PART = ".part"  # in the name of a file that is being written


def start(run, *arguments, title="new", **options):
    """Begins the run once more in its own folder, where an earlier result stands."""
    environment = os.environ | ({} if run.ranks > 1 else ALONE) | options.pop("environment", {})
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | options
    return subprocess.Popen(run.command + ["-title", title, *arguments], cwd=run.folder, env=environment, text=True, errors="replace", **streams)


def finish(process):
    """Exit code and what was said; longer than the time of a test is a hang."""
    stdout, stderr = process.communicate(timeout=TIMEOUT / 4)
    return process.returncode, stdout or "", stderr or ""


def wait_for_writing(run, process):
    """Until the first file is being written, or the run is over."""
    while process.poll() is None and not parts(run):
        time.sleep(0.0005)


def children(process):
    """Numbers of the ranks that mpiexec has started."""
    path = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
    return [int(number) for number in path.read_text().split()] if path.exists() else []


def parts(run):
    return [path.name for path in run.folder.iterdir() if PART in path.name]


def files(run):
    """Content of all files of results."""
    return {path.name: path.read_bytes() for path in run.folder.iterdir() if PART not in path.name}


def require_whole(run, before):
    """Beside a summary all files are of its run; without one, nothing is claimed. A run before that was killed may have left none."""
    summary = f"{NAME}.json"
    now = files(run)
    if summary not in now:
        return
    whole = set(before) | {summary}
    require(set(now) == whole, f"files are missing or too many: {sorted(set(now) ^ whole)}")
    if now[summary] == before.get(summary):
        require(now == before, "files of a run that was not finished stand beside the summary of an earlier one")
    else:
        require(run.fields().attrs["title"] == run.summary["scene"]["title"], "fields and summary are of different runs")


def ended_by(number):
    return f"ended by {signal.Signals(number).name}"
