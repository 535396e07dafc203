# wrong: every cell has nodes of its own, as some exporters write them: the pieces of the plate fall
# ends: 2
# says: body plate is in 4 pieces that touch and are not joined: 6 nodes coincide
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
    mesh = Msh(2)
    for i in range(4):
        mesh.block((i, 0), (i + 1, 1), (1, 1), "steel", {"left": "foot"} if i == 0 else {})
    mesh.write(folder / "plate.msh")
