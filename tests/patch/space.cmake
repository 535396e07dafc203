# One body in space: a constant strain, water on all sides, planes that meet obliquely; and a body in three contacts at once.
mortise_scene_test(strain CHECK strain.py RANKS 1 LONG_RANKS 3)
mortise_scene_test(oblique CHECK oblique.py RANKS 1 LONG_RANKS 3)
mortise_scene_test(oblique_plane CHECK oblique.py RANKS 1 LONG_RANKS 3)
mortise_scene_test(buoyant CHECK buoyant.py RANKS 1 LONG_RANKS 2)
mortise_scene_test(corner_of_three CHECK corner_of_three.py RANKS 1 LONG_RANKS 3)
