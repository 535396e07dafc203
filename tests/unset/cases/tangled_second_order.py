# wrong: a thin triangle of second order whose lower side bends more than its other sides are inclined, as at a coarse fillet
# ends: 1
# says: tangled cell of order 2
# says: Mesh.HighOrderOptimize
# says: Mesh.SecondOrderLinear
# ranks: 1 3
OPTIONS = """
-bodies plate
-order 2
-plate_dm_plex_filename plate.msh
-plate_young 1e3
-plate_poisson 0.3
-plate_bc_displacement top
-plate_bc_displacement_top 0,0
-plate_bc_traction bottom
-plate_bc_traction_bottom 0,-1
"""
MESH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "bottom"
1 2 "top"
2 3 "all"
$EndPhysicalNames
$Nodes
9
1 0 0 0
2 4 0 0
3 2 0.5 0
4 2 0.3 0
5 3 0.25 0
6 1 0.25 0
7 2 3 0
8 3 1.5 0
9 2 1.75 0
$EndNodes
$Elements
4
1 8 2 1 1 1 2 4
2 8 2 2 2 2 7 8
3 9 2 3 3 1 2 3 4 5 6
4 9 2 3 3 2 7 3 8 9 5
$EndElements
"""


def make(folder):
    (folder / "plate.msh").write_text(MESH, encoding="ascii")
