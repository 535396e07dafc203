# wrong: a plane mesh drawn in the x-z plane instead of the x-y plane
# ends: 1
# says: not parallel to the x,y plane
from msh import Msh

OPTIONS = """
-bodies plate
-plate_dm_plex_filename plate.msh
-plate_young 1
-plate_poisson 0.3
-plate_body_force 0,-1
-plate_bc_displacement foot
-plate_bc_displacement_foot 0,0
"""


def make(folder):
    mesh = Msh(2).block((0, 0), (2, 1), (4, 2), "steel", {"bottom": "foot"})
    mesh.nodes = [(x, z, y) for x, y, z in mesh.nodes]
    mesh.write(folder / "plate.msh")
