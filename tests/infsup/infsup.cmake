# The inf-sup number (eq. 11.9) is flat under uniform refinement of both sides.
mortise_scene_test(plane OWN_RUNS SCENE two_plates CHECK plane.py ARGS -infsup)
mortise_scene_test(solid OWN_RUNS SCENE patch3d CHECK solid.py ARGS -infsup -upper_dm_plex_box_faces 2,2,2 -lower_dm_plex_box_faces 3,3,2)
mortise_scene_test(axisymmetric SCENE shells CHECK flat.py
  ARGS -infsup -outer_dm_plex_box_faces 3,6 -inner_dm_plex_box_faces 2,4)
mortise_scene_test(axisymmetric_swapped LONG SCENE shells CHECK flat.py
  ARGS -infsup -outer_dm_plex_box_faces 3,4 -inner_dm_plex_box_faces 2,6)
mortise_scene_test(tied CHECK flat.py RANKS 1 LONG_RANKS 3 ARGS -infsup)
mortise_scene_test(curved LONG SCENE half_discs CHECK curved.py ARGS -infsup)
mortise_scene_test(obstacle SCENE fixture CHECK obstacle.py RANKS 1 LONG_RANKS 3 ARGS -infsup)
mortise_scene_test(floating SCENE stack CHECK floating.py RANKS 1 LONG_RANKS 3 ARGS -infsup)
# It is that of an independent computation, and falls for pairings that are not stable.
mortise_scene_test(independent SCENE two_plates CHECK independent.py RANKS 1 LONG_RANKS 3
  ARGS -infsup -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6)
mortise_scene_test(unstable OWN_RUNS SCENE two_plates CHECK unstable.py ARGS -infsup -upper_dm_plex_box_faces 4,4 -lower_dm_plex_box_faces 4,4)
mortise_scene_test(cut OWN_RUNS SCENE two_plates CHECK cut.py ARGS -infsup -upper_dm_plex_box_faces 16,16 -lower_dm_plex_box_faces 12,12)
# With load steps and multigrid; not at all where nobody asks; a contact that is too large.
mortise_scene_test(steps SCENE two_plates CHECK steps.py RANKS 1 LONG_RANKS 3 ARGS -infsup -load_steps 3
  -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -pc_type truncatedmg)
mortise_scene_test(too_many SCENE two_plates CHECK too_many.py
  ARGS -infsup -upper_dm_plex_box_faces 3001,1 -lower_dm_plex_box_faces 8,1 -dm_refine 0)
