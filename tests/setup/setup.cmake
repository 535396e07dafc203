# What a user is told of a set-up: loads that a support takes, motions that stay free, and all that -check tells without solving.
foreach(scene block ring brick)
  mortise_scene_test(lost_load_${scene} SCENE ${scene} CHECK lost_load.py RANKS 1 3)
endforeach()
mortise_scene_test(idle_contact SCENE slider CHECK idle_contact.py RANKS 1 LONG_RANKS 3)
mortise_scene_test(check SCENE two_plates CHECK check.py RANKS 1 LONG_RANKS 3)
mortise_scene_test(yaml SCENE slider CHECK yaml.py RANKS 1 LONG_RANKS 2)
mortise_scene_test(strict SCENE overhang CHECK strict.py ARGS -block_dm_plex_box_faces 8,8 -table_dm_plex_box_faces 8,8)
mortise_scene_test(doubtful SCENE lid CHECK doubtful.py RANKS 1 LONG_RANKS 3)
mortise_scene_test(held_corner CHECK held_corner.py RANKS 1 LONG_RANKS 3)
mortise_scene_test(tips SCENE tall CHECK tips.py RANKS 1 LONG_RANKS 3)
mortise_scene_test(soft_edge SCENE lid CHECK soft_edge.py RANKS 1 LONG_RANKS 3 ARGS -lid_young 2000 -lid_body_force 0,-0.01 -lid_dm_plex_box_faces 1,4
  -table_dm_plex_box_faces 6,4 -table_dm_plex_box_lower -0.5,-1 -table_bc_normal left)
