"""The same meshes and numbers as one rank has, with hexahedra that are kept."""
from judge import near, same


def judge(run):
    alone = run.again(ranks=1)
    mine, other = (one.summary["estimate"] for one in (run, alone))
    same("cells", [mesh["cells"] for mesh in mine["meshes"]], [mesh["cells"] for mesh in other["meshes"]])
    for key in ("potential", "estimate"):
        near(key, [mesh[key] for mesh in mine["meshes"]], [mesh[key] for mesh in other["meshes"]], relative=1e-9)
    for key in ("mean_pressure", "normal_force", "max_pressure"):
        near(key, run.pair("fit")[key], alone.pair("fit")[key], relative=1e-9)
