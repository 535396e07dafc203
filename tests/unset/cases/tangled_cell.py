# wrong: a node moved across its cells: they are tangled
# ends: 1
# says: tangled
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
    mesh.nodes[7] = (1.9, 0.9, 0.0)
    mesh.write(folder / "plate.msh")
