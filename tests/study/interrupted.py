"""A study that is told to end in its midst leaves complete files of all finished runs, and a sentence."""
import json
import pathlib
import signal
import subprocess
import time

from judge import NAME, TIMEOUT, require, same
from studies import block, rows, words

ENOUGH = 3  # finished runs after which the signal is sent


class Interrupted:
    """As a Run of judge.py, ended by a signal."""

    def __init__(self, run, number):
        self.folder = run.folder / signal.Signals(number).name
        self.folder.mkdir()
        command = run.command + ["-study_levels", "12", "-study_orders", "1,2"]
        process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        limit = time.monotonic() + TIMEOUT / 4
        while time.monotonic() < limit and process.poll() is None and self.finished() < ENOUGH:
            time.sleep(0.01)
        process.send_signal(number)
        self.stdout, self.stderr = process.communicate(timeout=TIMEOUT / 4)
        self.exit = process.returncode

    def finished(self):
        path = self.folder / f"{NAME}_study.csv"
        return path.read_text().count("\n") - 1 if path.exists() else 0

    @property
    def summary(self):
        return json.loads((self.folder / f"{NAME}.json").read_text())


def judge(run):
    for number in (signal.SIGTERM, signal.SIGINT):
        ended = Interrupted(run, number)
        if run.ranks == 1:
            same("end", ended.exit, -number)
        require(ended.exit != 0, "an interrupted study ends like a finished one")
        table = rows(ended)
        require(ENOUGH <= len(table) < 24 and all(row["status"] == "solved" for row in table), f"{len(table)} rows")
        if run.ranks == 1:  # mpiexec may be gone before it has passed on what ranks say last
            require(ended.stderr.count("mortise: interrupted; ") == 1, f"not one sentence on stderr: {ended.stderr}")
            require(f"{len(table)} finished runs" in ended.stderr, ended.stderr)
        same("runs in the summary", len(block(ended)["runs"]), len(table))
        require("order 2" in words(ended), "the chart misses a line")
        left = [path.name for path in pathlib.Path(ended.folder).iterdir() if ".part" in path.name]
        require(not left, f"temporary files are left: {left}")
