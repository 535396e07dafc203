# Every scene that is shipped, coarser where it takes more than seconds.
set(small_ball_in_socket -head_dm_plex_box_faces 4,4,2 -cup_dm_plex_box_faces 6,6,2)
set(small_cam -cam_dm_plex_box_faces 22,1,4 -follower_dm_plex_box_faces 20,1,4)
set(small_bolt_quarter -load_steps 1 -upper_dm_plex_box_faces 8,3,2 -lower_dm_plex_box_faces 8,2,2)
set(small_fretting -load_steps 1,2,3)
set(small_clamp -load_steps 0,0.6)
set(small_clutch -load_steps 0,1 -pc_type cholesky) # its seam has a hundredth of the pressures: multigrid keeps too few digits of these
set(small_ball_bearing -ball_dm_plex_box_faces 7,8,4 -ring_dm_plex_box_faces 6,7,4)
set(small_crossed_cylinders -upper_dm_plex_box_faces 5,5,3 -lower_dm_plex_box_faces 4,4,3)
set(small_hertz3d -sphere_dm_plex_box_faces 5,5,3 -block_dm_plex_box_faces 6,6,3)
set(small_spherical_gap -upper_dm_plex_box_faces 5,5,2 -lower_dm_plex_box_faces 4,4,2)
set(small_hertz2d_steps -load_steps 1)
set(small_mindlin -upper_dm_plex_box_faces 16,8,4 -lower_dm_plex_box_faces 16,8,4)
set(small_bolted_joint -load_steps 0,1)
set(small_contact_shapes -block_dm_plex_box_faces 6,6,4)
set(small_contact_zone_steps -load_steps 0.1,1)
set(small_validity -load_steps 1)
set(small_parabola_steps -load_steps 0.5,1 -adapt 3e-2)
set(small_wheel_on_rail -wheel_order 1)
file(GLOB scenes CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/options/*.opts)
foreach(path IN LISTS scenes)
  get_filename_component(shipped ${path} NAME_WE)
  mortise_scene_test(${shipped} CHECK same.py LABELS cross mpi ARGS -cross_check ${small_${shipped}})
endforeach()

# The same with cells of order 2, coarser where a scene is large: every sixth scene, all in the long run.
set(coarse_anisotropic_plate -board_dm_plex_box_faces 48,24)
set(coarse_manufactured_solid -upper_dm_plex_box_faces 2,2,2 -lower_dm_plex_box_faces 3,3,3)
set(coarse_overhang -block_dm_plex_box_faces 20,20 -table_dm_plex_box_faces 34,20)
set(coarse_parabola -block_dm_plex_box_faces 48,24)
set(coarse_two_plates -upper_dm_plex_box_faces 20,20 -lower_dm_plex_box_faces 15,15)
set(coarse_hertz2d -block_dm_plex_box_faces 48,24)
set(coarse_bolted_joint -load_steps 0,1 -plate_dm_plex_box_faces 20,10 -shank_dm_plex_box_faces 5,10 -head_dm_plex_box_faces 9,6)
set(coarse_hertz2d_steps -load_steps 1 -block_dm_plex_box_faces 48,24)
set(coarse_contact_zone -upper_dm_plex_box_faces 32,32 -lower_dm_plex_box_faces 24,24)
set(coarse_contact_zone_steps -load_steps 0.1,1 -upper_dm_plex_box_faces 32,32 -lower_dm_plex_box_faces 24,24)
set(coarse_contact_ring -block_dm_plex_box_faces 64,32)
set(coarse_validity -load_steps 1)
set(coarse_parabola_steps -load_steps 0.5,1 -adapt 1e-2)
set(coarse_mindlin -upper_dm_plex_box_faces 8,4,3 -lower_dm_plex_box_faces 8,4,3)
set(coarse_patch3d -upper_dm_plex_box_faces 2,3,2 -lower_dm_plex_box_faces 3,4,2)
set(number 0)
foreach(path IN LISTS scenes)
  get_filename_component(shipped ${path} NAME_WE)
  file(STRINGS ${path} quadratic REGEX "^-order 2")
  if(NOT quadratic)
    math(EXPR number "(${number} + 1) % 6")
    set(long LONG)
    if(number EQUAL 0)
      set(long)
    endif()
    mortise_scene_test(${shipped}_quadratic ${long} SCENE ${shipped} CHECK same.py LABELS cross mpi ARGS -cross_check -order 2 ${coarse_${shipped}})
  endif()
endforeach()

# Bodies of both orders, and multipliers at vertices alone.
mortise_scene_test(two_plates_mixed SCENE two_plates CHECK same.py LABELS cross mpi
  ARGS -cross_check -upper_order 2 -upper_dm_plex_simplex 1 ${coarse_two_plates})
mortise_scene_test(three_bodies_mixed SCENE three_bodies CHECK same.py LABELS cross mpi ARGS -cross_check -middle_order 2)
mortise_scene_test(hertz2d_mixed LONG SCENE hertz2d CHECK same.py LABELS cross mpi ARGS -cross_check -block_order 2 ${coarse_hertz2d})
mortise_scene_test(two_plates_vertices SCENE two_plates CHECK same.py LABELS cross mpi
  ARGS -cross_check -order 2 -joint_multipliers vertices ${coarse_two_plates})
mortise_scene_test(three_bodies_vertices LONG SCENE three_bodies CHECK same.py LABELS cross mpi
  ARGS -cross_check -order 2 -inner_fit_multipliers vertices -outer_fit_multipliers vertices)
mortise_scene_test(tied_vertices SCENE tied CHECK same.py LABELS cross mpi ARGS -cross_check -order 2 -glue_multipliers vertices)
mortise_scene_test(half_discs_vertices LONG SCENE half_discs CHECK same.py LABELS cross mpi ARGS -cross_check -order 2 -joint_multipliers vertices)

# Boxes of many cells, of which each rank makes its own, on up to eight ranks.
mortise_scene_test(parts LONG SCENE two_plates CHECK same.py RANKS 1 2 3 8 LABELS cross mpi
  ARGS -cross_check -upper_dm_plex_box_faces 72,71 -lower_dm_plex_box_faces 56,55 -upper_dm_plex_simplex 1)
mortise_scene_test(parts_solid SCENE spherical_gap CHECK same.py RANKS 1 LONG_RANKS 3 LABELS cross mpi
  ARGS -cross_check -order 1 -upper_dm_plex_box_faces 17,15,13 -lower_dm_plex_box_faces 9,11,9)

# Facets in another order.
mortise_scene_test(facet_order CHECK facet_order.py OWN_RUNS RANKS 1 2 LABELS cross)
