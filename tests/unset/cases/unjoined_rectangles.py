# wrong: two touching rectangles of one body whose meshes do not match: only the ends of the common line coincide
# ends: 0 unjoined_pieces
# says: body plate is in 2 pieces that touch and are not joined: 2 nodes coincide with one of another piece, and 7 facets lie on one
# says: Coherence
from msh import PLATE, Msh

OPTIONS = PLATE.replace("displacement foot", "displacement foot,rail") + "-plate_bc_displacement_rail 0,0\n"


def make(folder):
    mesh = Msh(2).block((0, 0), (1, 1), (3, 3), "steel", {"left": "foot"})
    mesh.block((1, 0), (2, 1), (4, 4), "steel", {"right": "rail"}).write(folder / "plate.msh")
