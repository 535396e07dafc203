# What a user is told of a set-up: loads that a support takes, motions that stay free, and all that -check tells without solving.
foreach(scene block ring brick)
  mortise_scene_test(lost_load_${scene} SCENE ${scene} CHECK lost_load.py RANKS 1 3)
endforeach()
mortise_scene_test(idle_contact SCENE slider CHECK idle_contact.py RANKS 1 3)
mortise_scene_test(check SCENE two_plates CHECK check.py RANKS 1 3)
mortise_scene_test(yaml SCENE slider CHECK yaml.py RANKS 1 2)
mortise_scene_test(strict SCENE overhang CHECK strict.py ARGS -block_dm_plex_box_faces 8,8 -table_dm_plex_box_faces 8,8)
