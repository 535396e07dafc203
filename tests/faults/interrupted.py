"""Signals at many moments, also ignored ones, and a rank that dies: no hang, no mixture of results, no unfinished file. The next run removes
what kill -9 leaves."""
import os
import random
import signal
import subprocess
import time

from judge import require, same
from world import children, ended_by, files, finish, parts, require_whole, start, wait_for_end, wait_for_writing

SETTING_UP = 0.3  # seconds, about the length of the run


def end(run, number, moment, whom=None):
    """Sends a signal at a moment; "writing" is soon after the first file was begun."""
    before = files(run)
    process = start(run, title=f"{signal.Signals(number).name} {moment}")
    if moment == "writing":
        wait_for_writing(run, process)
        time.sleep(random.uniform(0, 0.01))
    else:
        time.sleep(moment)
    targets = children(process) if whom == "rank" else [process.pid]
    for target in targets[-1:]:
        try:
            os.kill(target, number)
        except ProcessLookupError:
            pass
    code, _, _ = finish(process)
    if run.ranks == 1:
        require(code in (-number, 0), f"exit code {code}, {ended_by(number)}")
    if targets and files(run) == before:
        require(code != 0, f"a run {ended_by(number)} pretends that it was finished")
    require_whole(run, before)


def go_on(run):
    """A run that ignores SIGHUP, as under nohup, ends as usual, however often the signal comes."""
    process = start(run, title="ignored", preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
    while process.poll() is None:
        process.send_signal(signal.SIGHUP)
        time.sleep(0.005)
    code, _, stderr = finish(process)
    require(code == 0, f"exit code {code} of a run that ignores SIGHUP: {stderr}")


def judge(run):
    random.seed(5)
    if run.ranks == 1:  # mpiexec has a handler of its own
        go_on(run)
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        for moment in ("writing", "writing", random.uniform(0, SETTING_UP)):
            end(run, number, moment)
            if run.ranks == 1:  # mpiexec may give its ranks no time
                same(f"leftovers of a run {ended_by(number)}", parts(run), [])
    for moment in ("writing", "writing", random.uniform(0, SETTING_UP)):
        end(run, signal.SIGKILL, moment, "rank" if run.ranks > 1 else None)
    stay = ["result.h5.partner", f"result.h5.part{os.getpid()}"]
    for name in stay:
        (run.folder / name).write_text("of somebody else, of a process that is at work")
    with subprocess.Popen(["true"]) as ended:  # nobody asks for its exit code before the end of this block
        wait_for_end(ended.pid)
        for number in (999999999, ended.pid):
            (run.folder / f"result.h5.part{number}").write_text("left by a process that was killed")
        code, _, stderr = finish(start(run, title="last"))
    require(code == 0, f"exit code {code} of an undisturbed run: {stderr}")
    same("leftovers", sorted(parts(run)), sorted(stay))
    same("title", run.summary["scene"]["title"], "last")
