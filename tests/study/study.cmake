mortise_scene_test(manufactured SCENE manufactured_full CHECK manufactured.py RANKS 1 LONG_RANKS 2 LABELS sanitize
  ARGS -upper_dm_plex_box_faces 4,4 -lower_dm_plex_box_faces 6,6 -study uniform -study_levels 3 -study_orders 1,2)
mortise_scene_test(two_plates CHECK two_plates.py
  ARGS -upper_dm_plex_box_faces 4,4 -lower_dm_plex_box_faces 3,3 -study uniform -study_levels 4 -study_orders 1,2)
mortise_scene_test(ranks SCENE two_plates CHECK ranks.py RANKS 2 3
  ARGS -upper_dm_plex_box_faces 4,4 -lower_dm_plex_box_faces 3,3 -study uniform -study_levels 3 -study_orders 1,2)
mortise_scene_test(solvers SCENE two_plates CHECK solvers.py
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -study uniform -study_levels 3 -study_orders 1,2)
mortise_scene_test(own_orders SCENE two_plates CHECK own_orders.py
  ARGS -upper_dm_plex_box_faces 4,4 -lower_dm_plex_box_faces 3,3 -lower_order 2 -study uniform -study_levels 3 -title "\"Wood\" & <glue>")
mortise_scene_test(floating CHECK floating.py RANKS 1 2 ARGS -study uniform -study_levels 3 -study_orders 1,2)
set(what_it_takes ONLY_RANKS "its limit fits these ranks" UNSANITIZED "sanitizers take memory of their own, which no forecast knows")
mortise_scene_test(memory SCENE two_plates CHECK memory.py ${what_it_takes}
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -study uniform -study_levels 5 -study_orders 1,2 -study_memory 100M)
mortise_scene_test(memory_of_ranks SCENE two_plates CHECK memory.py RANKS 2 ${what_it_takes}
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -study uniform -study_levels 5 -study_orders 1,2 -study_memory 180M)
mortise_scene_test(interrupted SCENE two_plates CHECK interrupted.py RANKS 1 LONG_RANKS 2
  ARGS -upper_dm_plex_box_faces 4,4 -lower_dm_plex_box_faces 3,3 -study uniform -study_levels 1)
mortise_scene_test(not_solved SCENE two_plates CHECK not_solved.py
  ARGS -upper_dm_plex_box_faces 4,4 -lower_dm_plex_box_faces 3,3 -study uniform -study_levels 1)
mortise_scene_test(refused SCENE overhang CHECK refused.py RANKS 1 LONG_RANKS 2
  ARGS -block_dm_plex_box_faces 4,4 -table_dm_plex_box_faces 4,4 -study uniform -study_levels 1)
mortise_scene_test(cube CHECK cube.py RANKS 1 LONG_RANKS 2 ARGS -study uniform -study_levels 3 -study_orders 1,2)
mortise_scene_test(cube_tetrahedra LONG SCENE cube CHECK cube.py ARGS -study uniform -study_levels 3 -study_orders 1,2 -cube_dm_plex_simplex 1)
