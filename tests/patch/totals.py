"""Stresses of beams under total forces and moments, and their sums."""
from judge import near

def loads(run, side, force, moment, scale):
    load = run.summary["loads"][side]
    near("force", load["force"], force, absolute=1e-12 * scale)
    near("moment", load["moment"], moment, absolute=1e-12 * scale)
    return load


def judge(run):
    width, height = 2, 3
    x, y = 5.6 - 5, 1.3 - 0.5
    I_y, I_x = height * width**3 / 12, width * height**3 / 12
    for name, words in (("hexahedra", []), ("tetrahedra", ["-bar_dm_plex_simplex", "1"]), ("refined", ["-dm_refine", "1"])):
        other = run.again(*words, name=name)
        near("stress", other.probe("p")["stress"], [0, 0, 12 / (width * height) + 4 * x / I_y + 7 * y / I_x, 0, 0, 0], absolute=1e-11)
        load = loads(other, "bar:top", [0, 0, 12], [7, -4, 0], 12)
        near("centroid", load["centroid"], [5, 0.5, 5], relative=1e-13)
        near("area", load["area"], 6, relative=1e-13)
        loads(other, "bar:bottom", [0, 0, -12], [-7, 4, 0], 12)
    # torsion about an axis of symmetry has no force; order 1 adds up as well
    for order in "12":
        other = run.again("-order", order, "-bar_bc_moment_top", "1,2,3", "-bar_bc_moment_bottom", "-1,-2,-3", "-bar_map", "x,y,z+0.1*sin(x)*y", name=f"torsion{order}")
        loads(other, "bar:top", [0, 0, 12], [1, 2, 3], 12)
