"""What a solver leaves at open nodes is no traction: gaps are large there, and estimates are the same by multigrid as by a factorization."""
from judge import near, same


def judge(run):
    mine, other = (one.summary["estimate"] for one in (run, run.again("-pc_type", "truncatedmg", name="multigrid")))
    same("cells", [mesh["cells"] for mesh in other["meshes"]], [mesh["cells"] for mesh in mine["meshes"]])
    near("estimate", [mesh["estimate"] for mesh in other["meshes"]], [mesh["estimate"] for mesh in mine["meshes"]], relative=1e-6)
    near("calibration", other["calibration"], mine["calibration"], relative=1e-6)
