"""A run that is told to end in the midst of its meshes leaves the files of one that was solved, and a sentence."""
import json
import signal
import subprocess
import time

import h5py

from judge import NAME, TIMEOUT, require, same


def judge(run):
    folder = run.folder / "ended"
    folder.mkdir()
    arguments = ["-adapt", "1e-6", "-adapt_max_unknowns", "1e9"]  # minutes
    process = subprocess.Popen(run.command + arguments, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    limit = time.monotonic() + TIMEOUT / 2
    while time.monotonic() < limit and process.poll() is None and not (folder / f"{NAME}.json").exists():
        time.sleep(0.05)
    process.send_signal(signal.SIGTERM)
    _, stderr = process.communicate(timeout=TIMEOUT / 4)
    require(process.returncode != 0, "an interrupted run ends like a finished one")
    if run.ranks == 1:
        same("end", process.returncode, -signal.SIGTERM)
        require(stderr.count("mortise: interrupted; result.json and the other files hold mesh ") == 1, f"no sentence: {stderr}")
    summary = json.loads((folder / f"{NAME}.json").read_text())
    same("status", summary["status"], "not_converged")
    require(summary["bars"]["pairs"]["joint"]["normal_force"] > 0, "no bars")
    with h5py.File(folder / f"{NAME}.h5", "r") as file:
        same("nodes", file["points"].shape[0] if "points" in file else file["geometry"].shape[0], summary["estimate"]["meshes"][-1]["unknowns"] // 2)
    left = [path.name for path in folder.iterdir() if ".part" in path.name]
    require(not left, f"temporary files are left: {left}")
