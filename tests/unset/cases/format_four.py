# wrong: a file of Gmsh 4.0, an old format, of solids
# ends: 1
# says: its format is 4; formats 2.2 and 4.1 are accepted
# says: block.msh
from msh import Msh

OPTIONS = """
-bodies block
-block_dm_plex_filename block.msh
-block_young 1
-block_poisson 0.3
-block_body_force 0,0,-1
-block_bc_displacement floor
-block_bc_displacement_floor 0,0,0
"""


def make(folder):
    path = folder / "block.msh"
    Msh(3).block((0, 0, 0), (1, 1, 1), (2, 2, 2), "steel", {"bottom": "floor"}).write(path)
    path.write_text(path.read_text().replace("2.2 0 8", "4.0 0 8", 1))
