# Load steps: each is the solution that a run at its time alone has (singly.py), in all dimensions and with all solvers.
mortise_scene_test(plane SCENE two_plates CHECK singly.py RANKS 1 LONG_RANKS 3 LABELS sanitize
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -load_steps 0.2,0.5,0.4,1)
mortise_scene_test(axisymmetric SCENE hertz_axisymmetric CHECK singly.py RANKS 1 ARGS -load_steps 0.3,0.7,1)
mortise_scene_test(interference SCENE patch_interference CHECK singly.py RANKS 1 LONG_RANKS 3 ARGS -joint_gap "0-1e-3*t" -load_steps 0.5,1)
mortise_scene_test(floating SCENE overhang CHECK singly.py RANKS 1 LONG_RANKS 3
  ARGS -block_dm_plex_box_faces 8,8 -table_dm_plex_box_faces 8,8 -load_steps 0.2,0.6,1)
mortise_scene_test(tied CHECK singly.py ARGS -load_steps 2)
mortise_scene_test(solid SCENE stack3d CHECK singly.py ARGS -load_steps 0.4,1)
mortise_scene_test(multigrid SCENE two_plates CHECK singly.py RANKS 1 LONG_RANKS 3
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -dm_refine 2 -pc_type truncatedmg -ksp_rtol 1e-12 -load_steps 0.2,0.5,1)
mortise_scene_test(reduced_space SCENE two_plates CHECK singly.py
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -snes_type vinewtonrsls -load_steps 0.5,1)
mortise_scene_test(cross_check SCENE two_plates CHECK singly.py
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -cross_check -load_steps 0.5,1)
mortise_scene_test(factor_each_set SCENE two_plates CHECK singly.py
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -snes_pdas_reduce 0 -load_steps 0.5,1)
# Mistakes.
mortise_mistake(with_study SCENE two_plates ARGS -load_steps 3 -study uniform SAYS "-load_steps 3: -study solves")
mortise_mistake(no_steps SCENE two_plates RANKS 1 ARGS -load_steps 0 SAYS "-load_steps 0: must be a number of steps from 1 to")
mortise_mistake(no_time SCENE two_plates RANKS 1 ARGS -load_steps 0.5,soon SAYS "-load_steps" "soon")
mortise_mistake(no_kind SCENE two_plates RANKS 1 ARGS -load_steps 3 -load_steps_scale force SAYS "-load_steps_scale" "displacements")
mortise_mistake(scales_nothing SCENE two_plates RANKS 1 ARGS -load_steps_scale loads SAYS "-load_steps_scale: without load steps t is 1" "-load_steps")
mortise_mistake(none_alone SCENE two_plates RANKS 1 ARGS -load_steps 3 -load_steps_scale none,loads SAYS "-load_steps_scale" "none stands alone")

# What only some steps have: a reach that the last one exceeds, a stiffness or gap that names t, factors for each set.
mortise_scene_test(stiffness SCENE two_plates CHECK singly.py
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -upper_young "2e11*(1+t)" -load_steps 0.2,0.5,1)
mortise_scene_test(reach CHECK singly.py RANKS 1 LONG_RANKS 3 ARGS -load_steps 0.01,0.5,1)
mortise_scene_test(gap CHECK singly.py RANKS 1 LONG_RANKS 3)
mortise_scene_test(chosen SCENE two_plates CHECK chosen.py
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -load_steps 0.5,1 -load_steps_scale displacements)
# Against Hertz.
mortise_scene_test(hertz2d_steps CHECK hertz2d_steps.py)
mortise_scene_test(sphere SCENE hertz_axisymmetric CHECK sphere.py ARGS -load_steps 10)
# Files, and how a run ends.
mortise_scene_test(series SCENE two_plates CHECK series.py RANKS 1 LONG_RANKS 3
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -load_steps 0.5,0.2,1 -output_format xdmf,vtu)
mortise_scene_test(ends SCENE overhang CHECK ends.py RANKS 1 LONG_RANKS 2
  ARGS -block_dm_plex_box_faces 8,8 -table_dm_plex_box_faces 8,8 -load_steps 1)
mortise_scene_test(not_solved SCENE two_plates CHECK not_solved.py
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -load_steps 1)
mortise_scene_test(interrupted SCENE two_plates CHECK interrupted_steps.py RANKS 1 2
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -load_steps 2)
mortise_scene_test(charts SCENE two_plates CHECK charts.py
  ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6 -load_steps 0.5,1)
