# wrong: a bracket of two volumes of a CAD file that touch, meshed without BooleanFragments: the upper one is not joined to the lower
# ends: 0 unjoined_pieces
# says: body bracket is in 2 pieces that touch and are not joined: 9 nodes coincide with one of another piece, and 8 facets lie on one
# says: the first at (0, 0, 1)
# says: BooleanFragments
# ranks: 1 3
from msh import Msh

OPTIONS = """
-bodies bracket
-bracket_dm_plex_filename bracket.msh
-bracket_young 2e5
-bracket_poisson 0.3
-bracket_body_force 0,0,-1
-bracket_bc_displacement floor,wall
-bracket_bc_displacement_floor 0,0,0
-bracket_bc_displacement_wall 0,0,0
"""


def make(folder):
    mesh = Msh(3).block((0, 0, 0), (1, 1, 1), (2, 2, 2), "steel", {"bottom": "floor"})
    mesh.block((0, 0, 1), (1, 1, 2), (2, 2, 3), "steel", {"left": "wall"}).write(folder / "bracket.msh")
