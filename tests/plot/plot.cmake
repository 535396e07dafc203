# Pictures and pages: what they say, and where they say it.
mortise_scene_test(labels_ring SCENE shells CHECK labels.py ARGS -units mm,N,MPa -report)
mortise_scene_test(labels_plane LONG SCENE two_plates CHECK labels.py ARGS -units m,N,Pa -report)
mortise_scene_test(labels_solid LONG SCENE patch3d CHECK labels.py ARGS -units in,lbf,psi -report)

# Values along lines: against the exact linear displacement and uniform stress of patch tests, on any number of ranks.
mortise_scene_test(paths_plane SCENE patch2d CHECK paths.py RANKS 1 LONG_RANKS 3
  ARGS -paths down,slant -path_down_from 0.3,0.75 -path_down_to 0.3,-0.25 -path_down_points 11 -path_down_body upper
       -path_slant_from 0.1,0 -path_slant_to 0.9,0.5 -path_slant_body upper)
mortise_scene_test(paths_solid SCENE patch3d CHECK paths.py RANKS 1 LONG_RANKS 2
  ARGS -paths line -path_line_from 0.2,0.3,-0.1 -path_line_to 0.6,0.5,0.7 -path_line_points 9 -path_line_body upper)

mortise_scene_test(colours SCENE patch2d CHECK colours.py)
mortise_scene_test(temperature SCENE thermal_fit CHECK temperature.py)
mortise_scene_test(detail SCENE hertz2d CHECK detail.py)
mortise_scene_test(hanging SCENE two_plates CHECK hanging.py ARGS -upper_dm_plex_box_faces 2,2 -lower_dm_plex_box_faces 2,2 -adapt 1e-1 -adapt_cells kept)
mortise_scene_test(view SCENE below CHECK view.py)
mortise_scene_test(tidy_bolt SCENE bolt_quarter CHECK tidy.py ARGS -load_steps 1 -upper_dm_plex_box_faces 8,3,2 -lower_dm_plex_box_faces 8,2,2)
mortise_scene_test(tidy_fixture LONG SCENE fixture CHECK tidy.py)
mortise_scene_test(tidy_cam LONG SCENE cam CHECK tidy.py)
mortise_scene_test(clipped SCENE patch3d CHECK clipped.py)
mortise_scene_test(friction SCENE clamp CHECK friction.py ARGS -report)
mortise_scene_test(friction_solid SCENE clutch CHECK friction_solid.py)
mortise_scene_test(abroad SCENE patch2d CHECK abroad.py)
