# wrong: a bracket of two volumes of a CAD file that touch, meshed without BooleanFragments: the upper one is not joined to the lower
# ends: 0 unjoined_pieces
# says: body block is in 2 pieces that touch and are not joined: 9 nodes coincide with one of another piece, and 8 facets lie on one
# says: the first at (0, 0, 1)
# says: BooleanFragments
# ranks: 1 3
from msh import BLOCK, block

OPTIONS = BLOCK.replace("displacement floor", "displacement floor,wall") + "-block_bc_displacement_wall 0,0,0\n"


def make(folder):
    mesh = block({"bottom": "floor"})
    mesh.block((0, 0, 1), (1, 1, 2), (2, 2, 3), "steel", {"left": "wall"}).write(folder / "block.msh")
