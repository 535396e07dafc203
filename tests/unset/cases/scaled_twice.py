# wrong: a bracket in inches was scaled to millimetres in the CAD program and once more by a map: it overlaps the plate beside it
# ends: 0 overlapping_bodies
# says: bodies bracket and plate overlap
# says: no pair joins them
from msh import Msh

OPTIONS = """
-bodies bracket,plate
-bracket_dm_plex_filename bracket.msh
-bracket_map "25.4*x,25.4*y"
-bracket_young 1e3
-bracket_poisson 0.3
-bracket_body_force 0,-1e-6
-bracket_bc_displacement foot
-bracket_bc_displacement_foot 0,0
-plate_dm_plex_simplex 0
-plate_dm_plex_box_faces 8,8
-plate_dm_plex_box_lower 40,0
-plate_dm_plex_box_upper 60,20
-plate_young 1e3
-plate_poisson 0.3
-plate_bc_displacement top
-plate_bc_displacement_top 0,0
"""


def make(folder):
    Msh(2).block((0, 0), (25.4, 12.7), (4, 2), "steel", {"bottom": "foot"}).write(folder / "bracket.msh")
