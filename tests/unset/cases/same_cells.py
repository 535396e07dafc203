# wrong: two bodies of one file, and the regions forgotten: each body is made of all cells
# ends: 1
# says: -lower_mesh_region
# says: the file has the regions steel (1), wood (4)
# says: 24 cells
# ranks: 1 3
from msh import Msh

OPTIONS = """
-bodies upper,lower
-upper_dm_plex_filename two.msh
-upper_young 2e5
-upper_poisson 0.3
-upper_bc_displacement top
-upper_bc_displacement_top 0,-0.001
-lower_dm_plex_filename two.msh
-lower_young 1e4
-lower_poisson 0.3
-lower_bc_displacement floor
-lower_bc_displacement_floor 0,0
-pairs joint
-joint_nonmortar upper:foot
-joint_mortar lower:seat
"""


def make(folder):
    mesh = Msh(2).block((0, 0), (1, 1), (3, 4), "steel", {"top": "top", "bottom": "foot"})
    mesh.block((0, -1), (1, 0), (4, 3), "wood", {"top": "seat", "bottom": "floor"}).write(folder / "two.msh")
