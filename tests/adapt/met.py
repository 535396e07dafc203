"""The first mesh is as good as asked for, and one more tells the bars. It refines few cells, so it costs little more than
the first, and its bars hold the numbers of a much finer mesh."""
from judge import near, require, same


def judge(run):
    meshes = run.summary["estimate"]["meshes"]
    same("meshes", len(meshes), 2)
    require(meshes[1]["unknowns"] < 1.25 * meshes[0]["unknowns"], f"{meshes}")
    finer = run.again("-adapt", "4e-3")
    for number in ("normal_force", "area"):
        bar = run.summary["bars"]["pairs"]["joint"][number]
        require(finer.summary["bars"]["pairs"]["joint"][number] < bar, f"{number} is known to {bar}")
        near(number, run.pair("joint")[number], finer.pair("joint")[number], absolute=bar)
