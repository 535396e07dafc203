# Nearly incompressible bodies.
set(rubber -upper_poisson 0.4999 -lower_poisson 0.4999)
mortise_scene_test(seal CHECK seal.py)
mortise_scene_test(incompressible SCENE two_plates CHECK incompressible.py ARGS ${rubber} -order 1 -upper_dm_plex_box_faces 64,64 -lower_dm_plex_box_faces 64,64 -cross_check)
mortise_scene_test(incompressible_2 SCENE two_plates CHECK incompressible.py RANKS 1 LONG_RANKS 3
  ARGS ${rubber} -order 2 -upper_dm_plex_box_faces 40,40 -lower_dm_plex_box_faces 30,30 -cross_check)
mortise_scene_test(incompressible_triangles SCENE two_plates CHECK incompressible.py
  ARGS ${rubber} -order 2 -upper_dm_plex_simplex 1 -lower_dm_plex_simplex 1 -upper_dm_plex_box_faces 64,64 -lower_dm_plex_box_faces 64,64)
foreach(scene rings shells edge2d)
  mortise_scene_test(incompressible_${scene} SCENE ${scene} CHECK incompressible_orders.py)
endforeach()
