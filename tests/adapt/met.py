"""The first mesh is as good as asked for, and two more tell the bars. They refine few cells, so they cost little more than
the first (without that, 2.4 times its unknowns), and their bars hold the numbers of a much finer mesh."""
from judge import near, require, same


def judge(run):
    meshes = run.summary["estimate"]["meshes"]
    same("meshes", len(meshes), 3)
    require(meshes[2]["unknowns"] < 1.6 * meshes[0]["unknowns"], f"{meshes}")
    finer = run.again("-adapt", "4e-3")
    for number in ("normal_force", "area"):
        bar = run.summary["bars"]["pairs"]["joint"][number]
        require(finer.summary["bars"]["pairs"]["joint"][number] < bar, f"{number} is known to {bar}")
        near(number, run.pair("joint")[number], finer.pair("joint")[number], absolute=bar)
