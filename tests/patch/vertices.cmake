# Multipliers at the vertices of quadratic facets alone: covered wholly, in part, down to slivers, held at their ends.
mortise_scene_test(full_vertices SCENE full CHECK uniform.py RANKS 1 3 ARGS -order 2 -joint_multipliers vertices)
mortise_scene_test(wide_vertices SCENE wide CHECK wide.py ARGS -order 2 -first_multipliers vertices -second_multipliers vertices)
mortise_scene_test(crosspoints_vertices SCENE crosspoints CHECK uniform.py RANKS 1 3 ARGS -order 2 -joint_multipliers vertices)
