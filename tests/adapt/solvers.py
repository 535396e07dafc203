"""The same meshes with other solvers."""
from judge import near, same


def judge(run):
    for arguments in (["-snes_type", "vinewtonrsls"], ["-pc_type", "truncatedmg", "-ksp_rtol", "1e-12"], ["-cross_check"]):
        other = run.again(*arguments, name=arguments[-1].strip("-"))
        same("cells", [mesh["cells"] for mesh in other.summary["estimate"]["meshes"]], [mesh["cells"] for mesh in run.summary["estimate"]["meshes"]])
        near("potential", other.summary["energy"]["potential"], run.summary["energy"]["potential"], relative=1e-8)
