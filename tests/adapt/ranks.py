"""The same meshes and numbers as one rank has."""
from judge import near, same


def judge(run):
    alone = run.again(ranks=1)
    mine, other = (one.summary["estimate"] for one in (run, alone))
    same("cells", [mesh["cells"] for mesh in mine["meshes"]], [mesh["cells"] for mesh in other["meshes"]])
    for key in ("potential", "estimate"):
        near(key, [mesh[key] for mesh in mine["meshes"]], [mesh[key] for mesh in other["meshes"]], relative=1e-9)
    for name, pair in run.summary["pairs"].items():
        for key in ("mean_pressure", "normal_force", "max_pressure"):
            near(f"{key} of {name}", pair[key], alone.pair(name)[key], relative=1e-9)
        bars = [one.summary["bars"]["pairs"][name]["normal_force"] for one in (run, alone)]
        near(f"bar of the force of {name}", *bars, relative=1e-3)
    bars = [one.summary["bars"]["probes"] for one in (run, alone)]
    same("stresses without a bar", *[[value is None for probe in own.values() for value in probe["principal"]] for own in bars])
