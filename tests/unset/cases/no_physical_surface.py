# wrong: solids with a physical volume, and no physical surface for the support
# ends: 1
# says: body 'block' has no side 'floor'
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
    mesh = Msh(3).block((0, 0, 0), (1, 1, 1), (2, 2, 2), "steel")
    mesh.write(folder / "block.msh")
