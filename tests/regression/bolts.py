"""Two bolts that are tightened together: both sections carry their forces, the joint carries the sum."""
from judge import near


def judge(run):
    for name, force in (("one", 50), ("two", 80)):
        near(name, run.summary["pretension"][name]["force"], force, relative=1e-9)
        near(name, run.summary["reactions"][f"{name}:bottom"][2], -force, relative=1e-9)
    near("joint", run.pair("joint")["normal_force"], 130, relative=1e-9)
