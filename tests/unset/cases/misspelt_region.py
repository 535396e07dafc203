# wrong: a region of the file is misspelt
# ends: 1
# says: -plate_mesh_region stel
# says: steel
from msh import Msh

OPTIONS = """
-bodies plate
-plate_dm_plex_filename plate.msh
-plate_mesh_region stel
-plate_young 1
-plate_poisson 0.3
-plate_body_force 0,-1
-plate_bc_displacement foot
-plate_bc_displacement_foot 0,0
"""


def make(folder):
    mesh = Msh(2).block((0, 0), (2, 1), (4, 2), "steel", {"bottom": "foot"})
    mesh.write(folder / "plate.msh")
