"""The twin that is not turned: no maps, and the material's axes at 45 degrees."""
from judge import near, same


def judge(run):
    twin = run.again("-punch_map", "x, y", "-block_map", "x, y", "-block_material_angle", "45", name="twin")
    same("steps", run.summary["solver"]["changed"], twin.summary["solver"]["changed"])
    near("force", run.pair("joint")["normal_force"], 0.4, relative=1e-10)
    near("potential", run.summary["energy"]["potential"], twin.summary["energy"]["potential"], relative=1e-10)
    pressures = [[p for _, p in sorted(zip(solved.table("joint")["arc_length"], solved.table("joint")["pressure"]))] for solved in (run, twin)]
    near("pressure", *pressures, relative=1e-9)
