# One body in space against a closed formula; two by all linear solvers.
mortise_scene_test(cantilever CHECK cantilever.py)
# Contact of solids, against references and closed formulas.
mortise_scene_test(spherical_gap CHECK spherical_gap.py)
mortise_scene_test(shells3d CHECK shells3d.py)
mortise_scene_test(hertz3d CHECK hertz3d.py)
mortise_scene_test(manufactured_solid OWN_RUNS CHECK manufactured_solid.py ONLY_RANKS "its large meshes take minutes, and same/ has small ones on all ranks")
mortise_scene_test(two_blocks CHECK iterative.py)
mortise_scene_test(two_blocks_tet10 LONG SCENE two_blocks CHECK iterative.py
  ARGS -order 2 -upper_dm_plex_simplex 1 -upper_dm_plex_box_faces 4,4,2 -lower_dm_plex_box_faces 3,4,2)
