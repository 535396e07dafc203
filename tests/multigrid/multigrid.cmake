# Scenes of all kinds with multigrid on the levels of their meshes, small enough for a factorization to compare with.
# mg(<name> [LONG] [SCENE <scene>] ARGS ...): of options/ or of this folder; LONG: only in the long run
function(mg name)
  cmake_parse_arguments(arg "LONG" "SCENE" "ARGS" ${ARGN})
  if(NOT arg_SCENE)
    set(arg_SCENE ${name})
  endif()
  set(long)
  if(arg_LONG)
    set(long LONG)
  endif()
  mortise_scene_test(${name} ${long} SCENE ${arg_SCENE} CHECK multigrid.py LABELS mpi ARGS -pc_type cholesky ${arg_ARGS})
endfunction()
set(plane_coarse -upper_dm_plex_box_faces 10,10 -lower_dm_plex_box_faces 7,7)
set(solid_coarse -upper_dm_plex_box_faces 3,3,3 -lower_dm_plex_box_faces 2,2,2 -dm_refine 1)

# --- cells, orders, dimensions ---
mg(two_plates             ARGS ${plane_coarse} -dm_refine 2)
mg(two_plates_triangles   LONG SCENE two_plates ARGS ${plane_coarse} -upper_dm_plex_simplex 1 -lower_dm_plex_simplex 1 -dm_refine 2)
mg(two_plates_quadratic   SCENE two_plates ARGS ${plane_coarse} -order 2 -dm_refine 1)
mg(two_plates_vertices    LONG SCENE two_plates ARGS ${plane_coarse} -order 2 -upper_dm_plex_simplex 1 -joint_multipliers vertices -dm_refine 1)
mg(blocks                 ARGS ${solid_coarse})
mg(blocks_tetrahedra      LONG SCENE blocks ARGS ${solid_coarse} -upper_dm_plex_simplex 1 -lower_dm_plex_simplex 1)
mg(blocks_quadratic       LONG SCENE blocks ARGS ${solid_coarse} -order 2)
# one cell a body: of three ranks one has nothing, and planes of nodes to share
mg(blocks_long            SCENE blocks ARGS -upper_dm_plex_box_faces 1,1,1 -lower_dm_plex_box_faces 1,1,1 -dm_refine 2
                          -upper_dm_plex_box_upper 8,1,1 -lower_dm_plex_box_upper 8,1,0)

# --- what bodies touch ---
mg(three_bodies           ARGS -dm_refine 1)
mg(tied                   ARGS -dm_refine 2)
mg(rings                  LONG ARGS -dm_refine 1)
mg(patch_interference     ARGS -dm_refine 1)
mg(parabola               ARGS -block_dm_plex_box_faces 16,8 -dm_refine 1)
mg(touching               LONG ARGS -dm_refine 1)
mg(stack                  LONG ARGS -dm_refine 1)
mortise_scene_test(overhang CHECK floating.py LABELS mpi ARGS -pc_type cholesky -dm_refine 1)
mg(two_plates_uneven      LONG SCENE two_plates ARGS ${plane_coarse} -upper_young 8e10 -dm_refine 2)
mg(shells                 ARGS -dm_refine 1)
mg(two_plates_apart       LONG SCENE two_plates ARGS ${plane_coarse} -joint_gap 1 -dm_refine 2)
mg(two_plates_nearly      SCENE two_plates ARGS ${plane_coarse} -upper_poisson 0.49 -dm_refine 1)
mg(two_plates_tight       LONG SCENE two_plates ARGS ${plane_coarse} -upper_poisson 0.4999 -order 2 -dm_refine 1)
mg(blocks_tight           LONG SCENE blocks ARGS ${solid_coarse} -upper_poisson 0.49)

# --- meshes with one level, and levels made of some of its nodes below it ---
function(nodes name)
  cmake_parse_arguments(arg "" "SCENE" "ARGS" ${ARGN})
  mortise_scene_test(nodes_${name} SCENE ${arg_SCENE} CHECK nodes.py LABELS mpi ARGS -pc_type cholesky ${arg_ARGS})
endfunction()
nodes(file           SCENE half_discs)
nodes(quadratic      SCENE two_plates ARGS -order 2 -upper_dm_plex_simplex 1 -upper_dm_plex_box_faces 17,17 -lower_dm_plex_box_faces 13,13)
nodes(solid          SCENE blocks ARGS -upper_dm_plex_simplex 1 -upper_dm_plex_box_faces 9,9,9 -lower_dm_plex_box_faces 7,7,7)
nodes(floating       SCENE stack)
nodes(tied           SCENE tied)
mortise_scene_test(nodes_stiff SCENE blocks CHECK stiff.py ARGS -pc_type truncatedmg -upper_dm_plex_simplex 1 -upper_dm_plex_box_faces 21,21,18
  -upper_young 2e10 -lower_dm_plex_simplex 1 -lower_dm_plex_box_faces 16,16,14 -lower_young 5e8 -joint_gap "2*((x-0.4)^2+(y-0.45)^2)")

# --- stopping at the discretisation error ---
mortise_scene_test(stop SCENE two_plates CHECK stop.py RANKS 1 LONG_RANKS 3 LABELS mpi ARGS -upper_dm_plex_box_faces 64,64 -lower_dm_plex_box_faces 64,64
  -stop discretisation -pc_type truncatedmg)
mortise_scene_test(stop_apart SCENE two_plates CHECK stop_apart.py LABELS mpi ARGS ${plane_coarse} -dm_refine 2 -joint_gap 0.1 -stop discretisation)

# --- the second opinion ---
mortise_scene_test(opinion       SCENE two_plates CHECK opinion.py ARGS ${plane_coarse} -pc_type truncatedmg -cross_check -dm_refine 2)
mortise_scene_test(opinion_solid LONG SCENE blocks CHECK opinion.py LABELS mpi ARGS ${solid_coarse} -pc_type truncatedmg -cross_check)
mortise_scene_test(opinion_long  LONG SCENE parabola CHECK opinion.py LABELS mpi ARGS -block_dm_plex_box_faces 16,8 -dm_refine 1 -pc_type truncatedmg -cross_check)
mortise_scene_test(opinion_free  LONG SCENE stack CHECK opinion.py LABELS mpi ARGS -dm_refine 1 -pc_type truncatedmg -cross_check)
mortise_scene_test(pad CHECK pad.py LABELS mpi ARGS -pc_type truncatedmg -cross_check -cross_check_pc_type cholesky)

mortise_scene_test(hard OWN_RUNS SCENE touching CHECK hard.py ONLY_RANKS "its scenes have tests on ranks of their own")

# --- iterations ---
mortise_scene_test(long_cells OWN_RUNS SCENE hertz3d CHECK long_cells.py LABELS mpi ARGS -order 1 -dm_refine 1 -pc_type truncatedmg)
mortise_scene_test(long_tetrahedra OWN_RUNS SCENE hertz3d CHECK long_tetrahedra.py)
mortise_scene_test(tight LONG OWN_RUNS   SCENE two_plates CHECK tight.py LABELS mpi ARGS -order 2 -pc_type truncatedmg -dm_refine 1
  -upper_dm_plex_box_faces 16,16 -lower_dm_plex_box_faces 12,12)
set(tight_coarse ${plane_coarse} -pc_type truncatedmg -ksp_type cg)
mortise_scene_test(waves OWN_RUNS        SCENE two_plates CHECK waves.py LABELS mpi ARGS ${tight_coarse} -dm_refine 2 -upper_poisson 0.4999
  -lower_poisson 0.4999)
mortise_scene_test(pointwise OWN_RUNS    SCENE two_plates CHECK pointwise.py ARGS ${tight_coarse} -order 2 -upper_poisson 0.49 -lower_poisson 0.49
  -upper_dm_plex_simplex 1 -lower_dm_plex_simplex 1)
mortise_scene_test(growth       SCENE two_plates CHECK growth.py ARGS -upper_dm_plex_box_faces 8,8 -lower_dm_plex_box_faces 6,6)
mortise_scene_test(growth_solid SCENE blocks CHECK growth.py)
mortise_scene_test(afar         CHECK afar.py ARGS -pc_type truncatedmg)
mortise_scene_test(afar_quadratic SCENE afar CHECK afar.py ARGS -pc_type truncatedmg -order 2)
mortise_scene_test(sets OWN_RUNS         SCENE blocks CHECK sets.py)
# a third body that is not refined: the mesh has one level
mortise_scene_test(ahead OWN_RUNS        SCENE wheel_on_rail CHECK ahead.py LABELS mpi ARGS -order 1 -wheel_dm_refine 1 -rail_dm_refine 1 -pc_type truncatedmg
  -bodies wheel,rail,pad -pad_dm_plex_box_faces 1,1,1 -pad_dm_plex_box_lower 300,300,300 -pad_dm_plex_box_upper 310,310,310 -pad_young 210000
  -pad_poisson 0.3 -pad_bc_displacement bottom -pad_bc_displacement_bottom 0,0,0)
mortise_scene_test(own_levels OWN_RUNS   SCENE wheel_on_rail CHECK own_levels.py LABELS mpi ARGS -order 1 -pc_type truncatedmg -measure_linear)
mortise_scene_test(wander       CHECK wander.py ARGS -pc_type truncatedmg)
mortise_scene_test(zigzag       SCENE blocks CHECK zigzag.py ARGS -dm_refine 2 -upper_young 2e12 -pc_type truncatedmg)
mortise_scene_test(dealt        CHECK dealt.py ONLY_RANKS "it is with five ranks that one loses its blocks" RANKS 5 LABELS mpi ARGS -pc_type cholesky -dm_refine 3)
mortise_scene_test(rank_numbers SCENE wheel_on_rail CHECK rank_numbers.py LABELS mpi ARGS -pc_type truncatedmg)
mortise_scene_test(shorter      SCENE stiff_floor CHECK shorter.py LABELS mpi ARGS -pc_type cholesky -dm_refine 3)
mortise_scene_test(gives_way    SCENE blocks CHECK gives_way.py)
mortise_scene_test(chosen       SCENE two_plates CHECK chosen.py LABELS mpi ARGS -upper_dm_plex_box_faces 9,9 -lower_dm_plex_box_faces 7,7 -dm_refine 4)
mortise_scene_test(drags        LONG SCENE strips CHECK drags.py ARGS -a_dm_plex_box_faces 80,1,1 -a_dm_plex_box_upper 320,1,1)
mortise_scene_test(ball         LONG CHECK ball.py ARGS -order 2 -ball_dm_plex_box_faces 11,11,11)
