"""The same meshes and numbers as one rank has."""
from judge import near, same


def judge(run):
    alone = run.again(ranks=1)
    mine, other = (one.summary["estimate"] for one in (run, alone))
    same("cells", [mesh["cells"] for mesh in mine["meshes"]], [mesh["cells"] for mesh in other["meshes"]])
    for key in ("potential", "estimate"):
        near(key, [mesh[key] for mesh in mine["meshes"]], [mesh[key] for mesh in other["meshes"]], relative=1e-9)
    near("bar of the force", run.summary["bars"]["pairs"]["joint"]["normal_force"], alone.summary["bars"]["pairs"]["joint"]["normal_force"], relative=1e-3)
    bars = [one.summary["bars"]["probes"] for one in (run, alone)]
    same("stresses without a bar", *[[value is None for probe in own.values() for value in probe["principal"]] for own in bars])
