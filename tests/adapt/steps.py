"""Load steps on adaptive meshes. At each time they have the numbers that a run at that time alone has, to within the bars of both. Meshes
change in the series of files."""
import pathlib
import re
import xml.etree.ElementTree as ET

import h5py

from judge import Run, near, read_table, require, same

GAP = re.search(r'-joint_obstacle_gap "(.*)"', pathlib.Path(__file__).with_suffix(".opts").read_text())[1]


def judge(run):
    steps, tolerance = run.summary["steps"], float(run.arguments[run.arguments.index("-adapt") + 1])
    at = run.arguments.index("-load_steps")
    alone = run.arguments[:at] + run.arguments[at + 2:]
    same("times", [step["t"] for step in steps], [float(t) for t in run.arguments[at + 1].split(",")])
    for step in steps:
        require(step["status"] == "solved" and step["certificate"], f"t = {step['t']} is not solved")
        require(step["estimate"]["energy_norm_relative"] <= tolerance and len(step["estimate"]["meshes"]) >= 3, f"{step['estimate']} is not what was asked for")
        gap = ["-joint_obstacle_gap", GAP.replace("t", str(step["t"]))]
        single = Run(run.program, run.mpiexec, run.ranks, run.folder / f"t{step['t']}", alone + gap).summary
        for key in ("normal_force", "area", "max_pressure"):
            bars = step["bars"]["pairs"]["joint"][key] + single["bars"]["pairs"]["joint"][key]
            near(f"{key} at t = {step['t']}", step["pairs"]["joint"][key], single["pairs"]["joint"][key], absolute=bars)
            require(step["bars"]["pairs"]["joint"][key] < 0.2 * step["pairs"]["joint"][key], f"the bar of {key} says nothing")
        bar = step["bars"]["energy"]["potential"] + single["bars"]["energy"]["potential"]
        near(f"potential at t = {step['t']}", step["energy"]["potential"], single["energy"]["potential"], absolute=bar)
    cells = [step["estimate"]["meshes"][-1]["cells"] for step in steps]
    require(cells == sorted(cells) and cells[0] < cells[-1], f"meshes of {cells} cells")
    at = run.arguments.index("-adapt")
    plain = run.arguments[:at] + run.arguments[at + 2:]
    if "-adapt_cells" in plain:
        del plain[plain.index("-adapt_cells"):plain.index("-adapt_cells") + 2]
    fixed = Run(run.program, run.mpiexec, run.ranks, run.folder / "fixed", plain)
    table, plain = (read_table(folder / "result_steps.csv") for folder in (run.folder, fixed.folder))
    same("columns", list(table)[:len(plain)], list(plain))
    same("bars of the table", table["bar.joint.normal_force"], [step["bars"]["pairs"]["joint"]["normal_force"] for step in steps])
    same("errors of the table", table["error"], [step["estimate"]["energy_norm_relative"] for step in steps])
    for name in ("result", "result_joint"):
        judge_series(run.folder, name, steps, cells if name == "result" else None)


def judge_series(folder, name, steps, cells):
    grids = [grid for grid in ET.parse(folder / f"{name}.xdmf").getroot().iter("Grid") if grid.get("GridType") == "Uniform"]
    same("grids", len(grids), len(steps))
    with h5py.File(folder / f"{name}.h5", "r") as file:
        for grid, step in zip(grids, steps):
            near("time", float(grid.find("Time").get("Value")), step["t"], absolute=1e-12)
            for item in grid.iter("DataItem"):
                data, shape = file[item.text.split(":")[1]], tuple(int(n) for n in item.get("Dimensions").split())
                same(f"shape of {item.text}", data.shape[:len(shape)], shape)
            points = file[grid.find("Geometry/DataItem").text.split(":")[1]].shape[0]
            topology = file[grid.find("Topology/DataItem").text.split(":")[1]]
            require(topology[()].max() == points - 1, f"{grid.get('Name')}: cells name other points than those that are there")
            for item in grid.findall("Attribute"):
                if item.get("Center") == "Node":
                    same(item.get("Name"), file[item.find("DataItem").text.split(":")[1]].shape[0], points)
        for number, grid in enumerate(grids, 1):
            if cells:
                same("cells", int(grid.find("Topology").get("NumberOfElements")), cells[number - 1])
        same("the mesh of the last step", file["points"].shape, file[grids[-1].find("Geometry/DataItem").text.split(":")[1]].shape)
        same("the field of the last step", file["displacement"].shape[0], file["points"].shape[0])
