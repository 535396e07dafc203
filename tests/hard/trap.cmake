# -fp_trap ends a program that computes with what is not a number: no scene does.
set(trap_small -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -fp_trap)
mortise_scene_test(trap_contact SCENE two_plates RANKS 1 3 ARGS ${trap_small} -cross_check)
mortise_scene_test(trap_multigrid SCENE two_plates ARGS ${trap_small} -dm_refine 1 -pc_type truncatedmg -measure_linear -cross_check)
mortise_scene_test(trap_floating SCENE cases/adrift RANKS 1 3 ARGS -fp_trap -cross_check)
mortise_scene_test(trap_formula SCENE edge2d ARGS -fp_trap)
mortise_scene_test(trap_partly_covered SCENE anisotropic_plate ARGS -fp_trap)
