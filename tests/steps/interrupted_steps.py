"""Load steps that are told to end in their midst leave complete files of all finished steps, and a sentence."""
import json
import pathlib
import signal
import subprocess
import time

import h5py

from judge import NAME, TIMEOUT, read_table, require, same

ENOUGH = 3  # finished steps after which the signal is sent


def wait_for_steps(process, table):
    """Until enough steps are finished. Once it is there, their table is never missing: the next one replaces it."""
    limit, steps = time.monotonic() + TIMEOUT / 4, 0
    while time.monotonic() < limit and process.poll() is None and steps < ENOUGH:
        look = time.monotonic() + 0.01
        while steps and time.monotonic() < look:
            require(table.exists(), "the table of steps was missing for a while")
        if table.exists():
            steps = table.read_text().count("\n") - 1
        else:
            time.sleep(0.01)


def judge(run):
    for number in (signal.SIGTERM, signal.SIGINT):
        folder = run.folder / signal.Signals(number).name
        folder.mkdir()
        process = subprocess.Popen(run.command + ["-load_steps", "3000"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            wait_for_steps(process, folder / f"{NAME}_steps.csv")
        except BaseException:
            process.kill()
            raise
        process.send_signal(number)
        _, stderr = process.communicate(timeout=TIMEOUT / 4)
        if run.ranks == 1:
            same("end", process.returncode, -number)
            require(stderr.count("mortise: interrupted; ") == 1, f"not one sentence on stderr: {stderr}")
        require(process.returncode != 0, "interrupted load steps end like finished ones")
        judge_files(folder, stderr, run.ranks)


def judge_files(folder, stderr, ranks):
    table = read_table(folder / f"{NAME}_steps.csv")
    num = len(table["t"])
    require(ENOUGH <= num < 3000 and set(table["status"]) == {"solved"}, f"{num} rows")
    if ranks == 1:
        require(f"{num} finished steps" in stderr, stderr)
    same("steps in the summary", len(json.loads((folder / f"{NAME}.json").read_text())["steps"]), num)
    for name in (NAME, f"{NAME}_joint"):
        with h5py.File(folder / f"{name}.h5", "r") as file:
            same("steps in the file", len(file["steps"]), num)
            for group in file["steps"].values():
                require(abs(group["displacement"][()]).max() > 0, "a step has no displacement")
        same("steps in the series", (folder / f"{name}.xdmf").read_text().count("<Time "), num)
    left = [path.name for path in pathlib.Path(folder).iterdir() if ".part" in path.name]
    require(not left, f"temporary files are left: {left}")
