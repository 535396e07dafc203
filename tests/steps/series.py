"""The HDF5 files hold all steps, the last one also under the usual names; XDMF tells of one grid for each time."""
import xml.etree.ElementTree as xml

import h5py
import numpy as np

from judge import NAME, near, require, same

TIMES = [0.5, 0.2, 1]


def judge(run):
    left = [path.name for path in run.folder.iterdir() if ".part" in path.name]
    require(not left, f"temporary files are left: {left}")
    for name in (NAME, f"{NAME}_joint"):
        alone = [run.again("-load_steps", f"{t:.3f}", name=f"at{t}").folder for t in TIMES]
        judge_file(run.folder, name, alone)
        judge_series(run.folder / f"{name}.xdmf", name)


def judge_file(folder, name, alone):
    with h5py.File(folder / f"{name}.h5", "r") as file:
        same("groups", list(file["steps"]), ["0001", "0002", "0003"])
        same("times", [group.attrs["t"] for group in file["steps"].values()], TIMES)
        for place, group in enumerate(file["steps"].values()):
            with h5py.File(alone[place] / f"{name}.h5", "r") as other:
                same("quantities", set(group) | {"points", "cells", "body", "steps"}, set(other))
                for key in ("displacement", "pressure"):
                    size = abs(other[key][()]).max()
                    near(f"{key} of step {place + 1}", np.ravel(group[key][()]), np.ravel(other[key][()]), absolute=1e-9 * size)
        for key in file["steps/0003"]:
            same(f"{key} is that of the last step", file[key].id, file[f"steps/0003/{key}"].id)


def judge_series(path, name):
    grids = xml.parse(path).getroot().findall("./Domain/Grid/Grid")
    same("collection", xml.parse(path).getroot().find("./Domain/Grid").get("CollectionType"), "Temporal")
    same("names", [grid.get("Name") for grid in grids], ["t = 0.5", "t = 0.2", "t = 1"])
    same("times of viewers, which sort them", [float(grid.find("Time").get("Value")) for grid in grids], [1, 2, 3])
    with h5py.File(path.with_suffix(".h5"), "r") as file:
        for place, grid in enumerate(grids):
            for item in grid.iter("DataItem"):
                where, key = item.text.split(":")
                same("file", where, f"{name}.h5")
                same(f"shape of {key}", tuple(int(n) for n in item.get("Dimensions").split()), file[key].shape)
            require(any(f":/steps/000{place + 1}/displacement" in item.text for item in grid.iter("DataItem")), f"{path.name} misses a step")
