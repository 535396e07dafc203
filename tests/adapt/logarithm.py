"""Where two plates end together, the pressure grows like the logarithm of the size of facets. Seven meshes of order 1 tell that, 1800 unknowns."""
from judge import same


def judge(run):
    bars = run.summary["bars"]
    same("meshes", len(run.summary["estimate"]["meshes"]), 7)
    same("bars of what grows without limit", (bars["unbounded"], bars["pairs"]["joint"]["max_pressure"]), (["joint"], None))
