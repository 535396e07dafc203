# wrong: solids of which Gmsh wrote the surface alone, since only that is a physical group
# ends: 1
# says: this file has no solids
# says: physical volume
# ranks: 1 3
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
    mesh = Msh(3).block((0, 0, 0), (1, 1, 1), (2, 2, 2), "steel", {"bottom": "floor", "top": "lid"})
    mesh.elements = [element for element in mesh.elements if element[0] < 3]
    mesh.write(folder / "block.msh")
