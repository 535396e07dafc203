"""Common parts of the checks of this folder: runs that end too early, and the files that they may leave."""
import os
import pathlib
import signal
import subprocess
import time

from judge import ALONE, NAME, TIMEOUT, require

PART = ".part"  # in the name of a file that is being written
PATIENCE = 10  # seconds between two looks at a run that does not end
PAUSE = 0.0005  # seconds between two looks at one that is about to


def start(run, *arguments, title="new", **options):
    """Begins the run once more in its own folder, where an earlier result stands."""
    environment = os.environ | ({} if run.ranks > 1 else ALONE) | options.pop("environment", {})
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | options
    return subprocess.Popen(run.command + ["-title", title, *arguments], cwd=run.folder, env=environment, text=True, errors="replace",
                            start_new_session=True, **streams)


def finish(process):
    """Exit code and what was said, when all ranks have ended. Longer than the time of a run is a hang, not less: several ranks that wait for
    each other where others want the processors take minutes. An mpiexec whose ranks have all ended is not waited for: Open MPI now and then
    stops for ever in its own PMIx_server_finalize() when a signal comes early. It may also end before the ranks that it has killed."""
    limit, over = time.monotonic() + TIMEOUT, False
    while True:
        try:
            stdout, stderr = process.communicate(timeout=PATIENCE)
            while at_work(process.pid) and time.monotonic() < limit:
                time.sleep(PAUSE)
            require(not at_work(process.pid), "ranks outlive mpiexec")
            return process.returncode, stdout or "", stderr or ""
        except subprocess.TimeoutExpired:
            if time.monotonic() > limit:
                raise
            if over and ranks_ended(process):
                process.kill()
            over = ranks_ended(process)


def state_of(number):
    """What the system tells about a process: its state, its parent, group and session, ...; nothing of one that is no more."""
    try:
        return pathlib.Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return []


def has_ended(number):
    """Whether nothing is left of a process but its exit code, or not even that."""
    return state_of(number)[:1] in ([], ["Z"])


def at_work(session):
    """Numbers of the processes of a run that have not ended."""
    numbers = [path.name for path in pathlib.Path("/proc").glob("[0-9]*")]
    return [number for number in numbers if state_of(number)[3:4] == [str(session)] and not has_ended(number)]


def ranks_ended(process):
    """Whether mpiexec has children, and all of them have ended."""
    ranks = children(process)
    return bool(ranks) and all(map(has_ended, ranks))


def wait_for_end(number):
    """Until a process has ended; its exit code is left to whoever asks for it."""
    while not has_ended(number):
        time.sleep(PAUSE)


def wait_for_writing(run, process):
    """Until the first file is being written, or the run is over."""
    while process.poll() is None and not parts(run):
        time.sleep(PAUSE)


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
