"""Tetrahedra of graded boxes, and those cut from their hexahedra, are long in whole lines and planes. One system takes few iterations on them."""
from judge import require

ONE = ("-pc_type", "truncatedmg", "-measure_linear")
COARSE = ("-sphere_dm_plex_box_faces", "6,6,3", "-block_dm_plex_box_faces", "7,7,3")
CUT = ("-adapt", "0.99", "-adapt_max_meshes", "1")
BOXES = ("-sphere_dm_plex_simplex", "1", "-block_dm_plex_simplex", "1")
# options, most iterations of CG for one system to 1e-8; with diagonals of both bodies they were 20, 19 and 40
CASES = {"boxes": (("-order", "1", *BOXES), 10), "cut": (("-order", "1", *CUT), 10), "cut2": (("-order", "2", *CUT, *COARSE), 20)}


def judge(run):
    for name, (more, most) in CASES.items():
        count = run.again(*ONE, *more, name=name).summary["solver"]["linear_reference"]["iterations"]
        require(count <= most, f"{name}: {count} iterations")
