# Mistakes of a user: each changes a few options of a scene that is right, and is answered by one sentence that holds the
# words after SAYS (the option, its value, what would be accepted), by exit code 1, and by no file.
set(here ${CMAKE_CURRENT_LIST_DIR})

# mistake(<name> [SCENE <scene>] [ALONE] SAYS <text> ... ARGS ...): to boxes.opts, to another scene, or to none.
function(mistake name)
  cmake_parse_arguments(arg "ALONE" "SCENE" "SAYS;ARGS" ${ARGN})
  if(NOT arg_SCENE AND NOT arg_ALONE)
    set(arg_SCENE boxes)
  endif()
  mortise_mistake(${name} SCENE ${arg_SCENE} SAYS ${arg_SAYS} RANKS 1 2 ARGS ${arg_ARGS})
  set(tests mistakes.${name}.np1 mistakes.${name}.np2)
  set_tests_properties(${tests} PROPERTIES TIMEOUT 20)
endfunction()

# --- the command line and options files ---
mistake(no_file             ALONE SAYS -options_file no_such.opts ARGS -options_file no_such.opts)
mistake(malformed_quote     ALONE SAYS "quote.opts, line 2" "not closed" ARGS -options_file ${here}/quote.opts)
mistake(malformed_word      ALONE SAYS "word.opts, line 2" upper_young ARGS -options_file ${here}/word.opts)
mistake(malformed_equals    ALONE SAYS "equals.opts, line 1" -bodies=upper ARGS -options_file ${here}/equals.opts)
mistake(file_of_itself      ALONE SAYS itself.opts "names itself" ARGS -options_file ${here}/itself.opts)
mistake(stray_word          SAYS plates "one word too many" ARGS -title Two plates)
mistake(minus_formula       SAYS "-sin(x),0" "0-sin(x),0" ARGS -upper_bc_displacement_top "-sin(x),0")
mistake(no_bodies           ALONE SAYS -bodies missing ARGS -title Empty)

# --- names and misspelt options ---
mistake(misspelt_option     SAYS "-tickness 2" "-thickness?" ARGS -tickness 2)
mistake(misspelt_of_body    SAYS "-upper_yuong 1" "-upper_young?" ARGS -upper_yuong 1)
mistake(misspelt_prefix     SAYS "-uper_young 1" "-upper_young?" ARGS -uper_young 1)
mistake(misspelt_of_pair    SAYS "-joint_gap_ofset 1" "-joint_gap_offset?" ARGS -joint_gap_ofset 1)
mistake(misspelt_side       SAYS -lower_bc_tracton_left "-lower_bc_traction_left?" ARGS -lower_bc_tracton_left 1,1)
mistake(misspelt_of_box     SAYS -third_dm_plex_box_face "-third_dm_plex_box_faces?" ARGS -bodies upper,lower,third -third_dm_plex_box_face 2,2)
mistake(misspelt_of_solver  SAYS "-snes_pdas_strt full" "-snes_pdas_start?" ARGS -snes_pdas_strt full)
mistake(misspelt_of_petsc   SAYS "-ksp_rtoll 1e-9" "-ksp_rtol?" ARGS -ksp_rtoll 1e-9)
mistake(idle_of_petsc       SAYS "-snes_linesearch_type bt" "nothing reads" ARGS -snes_linesearch_type bt)
mistake(unknown_option      SAYS "-gravity_of_earth 9.81" -help ARGS -gravity_of_earth 9.81)
mistake(idle_option         SAYS "-upper_material_angle 30" -upper_stiffness ARGS -upper_material_angle 30)
mistake(name_twice          SAYS -bodies upper twice ARGS -bodies upper,lower,upper)
mistake(name_illegal        SAYS 2nd letter ARGS -bodies upper,lower,2nd)
mistake(name_of_petsc       SAYS ksp PETSc ARGS -bodies upper,lower,ksp)
mistake(name_clash          SAYS upper_bc_traction "option of both" ARGS -bodies upper,lower,upper_bc_traction)
mistake(name_number         SAYS upper_2 "rename one" ARGS -bodies upper,lower,upper_2)
mistake(name_empty          SAYS "-bodies upper,,lower" empty ARGS -bodies upper,,lower)

# --- the scene as a whole ---
mistake(model_misspelt      SAYS "-model plane_stran" plane_stress "did you mean plane_strain?" ARGS -model plane_stran)
mistake(model_solid         SAYS "-upper_dm_plex_box_faces" "-model solid has three dimensions" ARGS -model solid)
mistake(model_plane         SAYS "-upper_dm_plex_box_faces 4,4,4" "give two, or -model solid" ARGS -model plane_strain -upper_dm_plex_box_faces 4,4,4)
mistake(solid_thickness     SAYS "-thickness 2" "a solid has" ARGS -model solid -thickness 2 -upper_dm_plex_box_faces 4,4,4 -lower_dm_plex_box_faces 4,4,4)
mistake(solid_map           SAYS "-upper_map" "3 wanted" ARGS -upper_map "x,y" -upper_dm_plex_box_faces 4,4,4 -lower_dm_plex_box_faces 4,4,4)
mistake(ring_thickness      SAYS "-thickness 2" "whole ring" ARGS -model axisymmetric -thickness 2)
mistake(ring_beyond_axis    SAYS "-model axisymmetric" upper "r = -0.5" "r >= 0" ARGS -model axisymmetric -upper_map "x-0.5,y")
mistake(ring_off_axis       SAYS upper "on the axis of revolution" contradict ARGS -model axisymmetric -upper_bc_displacement_top 0.1,0)
mistake(ring_stiffness      SAYS -third_stiffness "10 wanted"
  ARGS -model axisymmetric -bodies upper,lower,third -third_dm_plex_box_faces 1,1 -third_stiffness 3,1,0,3,0,1)
mistake(thickness_zero      SAYS "-thickness 0" "above 0" ARGS -thickness 0)
mistake(thickness_text      SAYS -thickness thin numbers ARGS -thickness thin)
mistake(order_half          SAYS "-order 1.5" "1, 2" ARGS -order 1.5)
mistake(refine_negative     SAYS "-dm_refine -1" "smallest value is 0" ARGS -dm_refine -1)
mistake(refine_text         SAYS "-dm_refine twice" "whole number" ARGS -dm_refine twice)
mistake(refine_beyond       SAYS -upper_dm_plex_box_faces "-dm_refine" "more than can be numbered" ARGS -dm_refine 20)
mistake(boolean             SAYS "-cross_check perhaps" yes no ARGS -cross_check perhaps)
mistake(solver_unbounded    SAYS "-snes_type newtonls" pdas vinewtonrsls bounds ARGS -snes_type newtonls)
mistake(solver_steps        SAYS "-snes_max_it 0" "at least 1" ARGS -snes_max_it 0)
mistake(solver_start        SAYS -snes_pdas_start filled ARGS -snes_pdas_start filled)
mistake(solver_constant     SAYS -snes_pdas_c ARGS -snes_pdas_c -1)
mistake(linear_type         SAYS -ksp_type conjugate ARGS -ksp_type conjugate)
mistake(petsc_number        SAYS -ksp_rtol small ARGS -ksp_rtol small)

# --- meshes ---
mistake(mesh_none           SAYS -third_dm_plex_box_faces -third_dm_plex_filename ARGS -bodies upper,lower,third)
mistake(mesh_missing        SCENE mesh SAYS -block_dm_plex_filename no_such.msh ARGS -block_dm_plex_filename no_such.msh)
mistake(mesh_folder         SCENE mesh SAYS -block_dm_plex_filename mistakes ARGS -block_dm_plex_filename ${here})
mistake(mesh_text           SCENE mesh SAYS -block_dm_plex_filename text.msh ARGS -block_dm_plex_filename ${here}/text.msh)
mistake(mesh_cut            SCENE mesh SAYS -block_dm_plex_filename cut.msh ARGS -block_dm_plex_filename ${here}/cut.msh)
mistake(mesh_node           SCENE mesh SAYS -block_dm_plex_filename node.msh ARGS -block_dm_plex_filename ${here}/node.msh)
mistake(mesh_volume         SCENE mesh SAYS volume.msh "dimension 3" "-model plane_strain has 2" "-model solid" ARGS -model plane_strain
        -block_dm_plex_filename ${here}/volume.msh)
mistake(mesh_plane          SCENE mesh SAYS triangles.msh "dimension 2" "-model solid has 3" "gmsh -3" ARGS -model solid -block_dm_plex_filename
        ${here}/triangles.msh)
mistake(mesh_mixed          SAYS volume.msh "same dimensions" "this one has 3" "-upper_dm_plex_box_faces 4,3 has 2" ARGS
        -bodies upper,lower,block -block_dm_plex_filename ${here}/volume.msh)
mistake(mesh_solid          SCENE mesh SAYS -block_bc_displacement_bottom "0,0" "2 components given, 3 wanted" ARGS -block_dm_plex_filename ${here}/volume.msh)
mistake(mesh_partitioned    SCENE mesh SAYS parts.msh "cut into partitions" whole ARGS -block_dm_plex_filename ${here}/parts.msh)
mistake(mesh_merged         SCENE mesh SAYS merged.msh "quadrangles has one node at several of its corners" ARGS -block_dm_plex_filename
        ${here}/merged.msh)
mistake(mesh_flat           SCENE mesh SAYS block degenerate ARGS -block_dm_plex_filename ${here}/flat.msh)
mistake(mesh_tangled        SCENE mesh SAYS block tangled ARGS -block_dm_plex_filename ${here}/tangled.msh)
mistake(mesh_side           SCENE mesh SAYS botom bottom slope ARGS -block_dm_plex_filename ${here}/triangles.msh -block_bc_displacement botom
  -block_bc_displacement_botom 0,0 -options_allow_unused)
mistake(mesh_region         SCENE mesh SAYS -block_mesh_region steel wood ARGS -block_dm_plex_filename ${here}/triangles.msh -block_mesh_region steel)
mistake(solid_plane         SCENE brick SAYS triangles.msh "dimension 2" "gmsh -3" ARGS -block_dm_plex_filename ${here}/triangles.msh)
mistake(solid_wedge         SCENE brick SAYS roof.msh "1 wedges" "(0, 0, 1)" tetrahedra ARGS -block_dm_plex_filename ${here}/roof.msh)
mistake(solid_twisted       SCENE brick SAYS block tangled "(0, 0, 2)" ARGS -block_dm_plex_filename ${here}/twisted.msh)
mistake(solid_sheet         SCENE brick SAYS sheet.msh "physical group 2" "not a facet" ARGS -block_dm_plex_filename ${here}/sheet.msh)
mistake(solid_side_volume   SCENE brick SAYS steel volume "floor (1)" ARGS -block_dm_plex_filename ${here}/bricks.msh -block_bc_displacement steel
  -block_bc_displacement_steel 0,0,0 -options_allow_unused)
mistake(solid_side_inside   SCENE brick SAYS joint inside "(0, 0, 1)" -block_mesh_region ARGS -block_dm_plex_filename ${here}/bricks.msh
  -block_bc_displacement joint -block_bc_displacement_joint 0,0,0 -options_allow_unused)
mistake(solid_region        SCENE brick SAYS "-block_mesh_region joint" surface "steel (1), wood (2)" ARGS -block_dm_plex_filename ${here}/bricks.msh
  -block_mesh_region joint)
mistake(box_and_file        SAYS -upper_dm_plex_box_faces "-upper_dm_plex_filename ${here}/triangles.msh"
  ARGS -upper_dm_plex_filename ${here}/triangles.msh)
mistake(box_count           SAYS "-upper_dm_plex_box_faces 4" "2 wanted" ARGS -upper_dm_plex_box_faces 4)
mistake(box_solid           SAYS "-upper_dm_plex_box_faces 4,4,4" "same dimensions" -lower_dm_plex_box_faces ARGS -upper_dm_plex_box_faces 4,4,4)
mistake(box_empty           SAYS "-upper_dm_plex_box_upper 1,0" "empty along y" ARGS -upper_dm_plex_box_upper 1,0)
mistake(map_count           SAYS -upper_map "2 wanted" ARGS -upper_map x)
mistake(map_folds           SAYS "-upper_map (x-0.5)^2,y" folds ARGS -upper_map "(x-0.5)^2,y")
mistake(map_infinite        SAYS -upper_map "not a finite number" ARGS -upper_map "log(x-0.5),y")

# --- materials ---
mistake(young_missing       SAYS -third_young missing -third_stiffness ARGS -bodies upper,lower,third -third_dm_plex_box_faces 1,1)
mistake(poisson_missing     SAYS -third_poisson missing ARGS -bodies upper,lower,third -third_dm_plex_box_faces 1,1 -third_young 1)
mistake(young_zero          SAYS "-upper_young 0" "above 0" ARGS -upper_young 0)
mistake(young_negative      SAYS "-upper_young -8e9" "above 0" ARGS -upper_young -8e9)
mistake(young_text          SAYS -upper_young steel numbers ARGS -upper_young steel)
mistake(young_varying       SAYS upper ARGS -upper_young "8e9*(x-0.5)")
mistake(poisson_half        SAYS "-upper_poisson 0.5" "mixed method" "below 0.4999995" ARGS -upper_poisson 0.5)
mistake(poisson_near_half   SAYS "-upper_poisson 0.4999995" "mixed method" "below 0.4999995" ARGS -upper_poisson 0.4999995)
mistake(poisson_varying     SAYS upper "nu < 0.4999995" ARGS -upper_poisson "0.4999996+0*x")
mistake(lock_triangles      SAYS "-upper_poisson 0.46" "triangles of order 1" 0.45 quadrilaterals "-upper_order 2"
  ARGS -upper_poisson 0.46 -upper_dm_plex_simplex 1)
mistake(lock_varying        SAYS "-upper_poisson 0.3+0.19*x" "triangles of order 1" 0.45 ARGS -upper_poisson "0.3+0.19*x" -upper_dm_plex_simplex 1)
mistake(lock_tetrahedra     SCENE solid SAYS "-block_poisson 0.48" "tetrahedra of order 1" 0.45 hexahedra "-block_order 2"
  ARGS -block_poisson 0.48 -block_dm_plex_simplex 1)
mistake(lock_tetrahedra_2   SCENE solid SAYS "-block_poisson 0.499" "tetrahedra of order 2" 0.49 hexahedra
  ARGS -block_poisson 0.499 -block_dm_plex_simplex 1 -order 2)
mistake(poisson_beyond      SAYS "-upper_poisson 3" "below 0.5" ARGS -upper_poisson 3)
mistake(stiffness_both      SAYS "-upper_young 8e9" -upper_stiffness ARGS -upper_stiffness 3,1,0,3,0,1)
mistake(stiffness_count     SAYS -third_stiffness "6 wanted" ARGS -bodies upper,lower,third -third_dm_plex_box_faces 1,1 -third_stiffness 3,1,3,1)
mistake(stiffness_indefinite SAYS "-third_stiffness 1,2,0,1,0,1" "positive definite"
  ARGS -bodies upper,lower,third -third_dm_plex_box_faces 1,1 -third_stiffness 1,2,0,1,0,1)

# --- supports and loads ---
mistake(side_of_box         SAYS "-lower_bc_traction lft" "left, right, bottom, top" ARGS -lower_bc_traction lft -lower_bc_traction_lft 1,1)
mistake(side_twice          SAYS -lower_bc_traction left twice ARGS -lower_bc_traction left,left+right -lower_bc_traction_left 1,1)
mistake(datum_missing       SAYS -lower_bc_traction_left missing ARGS -lower_bc_traction left)
mistake(datum_unlisted      SAYS "-lower_bc_pressure_left 1" "-lower_bc_pressure" ARGS -lower_bc_pressure_left 1)
mistake(datum_count         SAYS -upper_bc_displacement_top "2 wanted" ARGS -upper_bc_displacement_top 0)
mistake(datum_infinite      SAYS -lower_bc_pressure_left "not a finite number" ARGS -lower_bc_pressure left -lower_bc_pressure_left "sqrt(y)")
mistake(datum_free          SAYS -lower_bc_traction_left free ARGS -lower_bc_traction left -lower_bc_traction_left free,1)
mistake(datum_parenthesis   SAYS -upper_body_force ARGS -upper_body_force "(1+x,0")
mistake(held_and_loaded     SAYS -upper_bc_traction top free ARGS -upper_bc_traction top -upper_bc_traction_top 0,1)
mistake(held_and_pressed    SAYS -lower_bc_pressure left -lower_bc_normal ARGS -lower_bc_normal left -lower_bc_pressure left -lower_bc_pressure_left 1)
mistake(held_twice          SAYS lower ARGS -lower_bc_displacement bottom,left -lower_bc_displacement_left 0.1,0)
mistake(normal_on_arc       SAYS -upper_bc_normal flat ARGS -upper_map "(1+x)*cos(y),(1+x)*sin(y)" -upper_bc_normal right)

# --- pairs and obstacles ---
mistake(pair_no_side        SAYS "-joint_nonmortar bottom" body:side ARGS -joint_nonmortar bottom)
mistake(pair_no_body        SAYS "-joint_nonmortar uper:bottom" "upper, lower" "did you mean upper?" ARGS -joint_nonmortar uper:bottom)
mistake(pair_misspelt_side  SAYS "-joint_mortar lower:tpo" "left, right, bottom, top" ARGS -joint_mortar lower:tpo)
mistake(pair_of_itself      SAYS upper:bottom itself ARGS -joint_mortar upper:bottom)
mistake(pair_held           SAYS -joint_nonmortar upper:top -upper_bc_displacement ARGS -joint_nonmortar upper:top)
mistake(pair_missing_mortar SAYS -again_mortar missing -again_obstacle ARGS -pairs joint,again -again_nonmortar upper:left)
mistake(pair_twice          SAYS joint again "same two sides" ARGS -pairs joint,again -again_nonmortar lower:top -again_mortar upper:bottom)
mistake(pair_both           SAYS "-joint_nonmortar upper:bottom" -joint_sides ARGS -joint_sides upper:bottom,lower:top)
mistake(pair_type           SAYS "-joint_type glued" "contact, tied" ARGS -joint_type glued)
mistake(pair_tied_gap       SAYS "-joint_gap 1e-3" tied ARGS -joint_type tied -joint_gap 1e-3)
mistake(pair_gap_count      SAYS -joint_gap "1 wanted" ARGS -joint_gap 1,2)
mistake(pair_reach          SAYS "-joint_reach -1" "above 0" ARGS -joint_reach -1)
mistake(obstacle_and_mortar SAYS "-joint_obstacle plane" "-joint_mortar lower:top" ARGS -joint_obstacle plane)
mistake(obstacle_misspelt   SAYS "-wall_obstacle plain" "did you mean plane?" ARGS -pairs joint,wall -wall_nonmortar upper:left -wall_obstacle plain)
mistake(obstacle_normal     SAYS "-wall_obstacle_normal 0,0" zero
  ARGS -pairs joint,wall -wall_nonmortar upper:left -wall_obstacle plane -wall_obstacle_normal 0,0)
mistake(obstacle_radius     SAYS "-wall_obstacle_radius 0" zero
  ARGS -pairs joint,wall -wall_nonmortar upper:left -wall_obstacle circle -wall_obstacle_radius 0)
mistake(obstacle_flat       SCENE solid SAYS "-floor_obstacle circle" "ball or cylinder" ARGS -floor_obstacle circle)
mistake(obstacle_axis       SCENE solid SAYS "-floor_obstacle_axis 0,0,0" zero ARGS -floor_obstacle_axis 0,0,0)
mistake(obstacle_axis_flat  SCENE solid SAYS "-floor_obstacle_axis" "3 wanted" ARGS -floor_obstacle_axis 0,1)
mistake(obstacle_point_flat SCENE solid SAYS "-floor_obstacle_point" "3 wanted" ARGS -floor_obstacle_point 0,1)
mistake(obstacle_axis_none  SAYS "-wall_obstacle cylinder" "write circle" ARGS -pairs joint,wall -wall_nonmortar upper:left -wall_obstacle cylinder)
mistake(obstacle_axis_idle  SCENE solid SAYS "-floor_obstacle_axis 1,0,0" nothing ARGS -floor_obstacle ball)
mistake(obstacle_gap        SAYS -wall_obstacle_gap missing ARGS -pairs joint,wall -wall_nonmortar upper:left -wall_obstacle expression)
mistake(torn_side           SAYS -joint_multipliers nodes -second_multipliers vertices
  ARGS -order 2 -pairs joint,second -second_nonmortar upper:bottom -second_obstacle plane
  -second_obstacle_point 0,-1 -second_obstacle_normal 0,1 -second_multipliers vertices)
mistake(role_circle         SCENE circle SAYS spring summer autumn winter ARGS -title "Seasons")

# --- exact solutions and studies ---
mistake(exact_count         SAYS -upper_exact_displacement "2 wanted" ARGS -upper_exact_displacement x)
mistake(exact_formula       SAYS -upper_exact_displacement "'sine' is not known" ARGS -upper_exact_displacement "sine(x),0")
mistake(exact_of_tied       SAYS "-joint_exact_pressure 1" tied ARGS -joint_type tied -joint_exact_pressure 1)
mistake(exact_pressure_count SAYS -joint_exact_pressure "1 wanted" ARGS -joint_exact_pressure 0,1)
mistake(exact_infinite      SAYS -lower_exact_displacement "not a finite number" ARGS -lower_exact_displacement "log(x),0")
mistake(exact_contradicts   SAYS "-lower_exact_displacement: at (" "lower:bottom" "the support gives 0" ARGS -lower_exact_displacement "x,y")
mistake(exact_pressure_infinite SAYS -joint_exact_pressure "not a finite number" ARGS -joint_exact_pressure "sqrt(x-0.5)")
mistake(multipliers         SAYS "-joint_multipliers edges" "nodes, vertices" ARGS -joint_multipliers edges)
mistake(study_misspelt      SAYS "-study unifrom" "did you mean uniform?" ARGS -study unifrom)
mistake(study_adaptive      SAYS "-study adaptive" "uniform only" ARGS -study adaptive)
mistake(study_none          SAYS "-study_levels 3" "With -study" ARGS -study_levels 3)
mistake(study_levels        SAYS "-study_levels 0" "smallest value is 1" ARGS -study uniform -study_levels 0)
mistake(study_beyond        SAYS -upper_dm_plex_box_faces "-study_levels" "more than can be numbered" ARGS -study uniform -study_levels 20)
mistake(study_orders        SAYS "-study_orders 2,1" "lower one first" ARGS -study uniform -study_orders 2,1)
mistake(study_own_order     SAYS "-upper_order 2" "-study_orders" ARGS -study uniform -study_orders 1,2 -upper_order 2)
mistake(study_pair          SAYS "-pairs study" "result_study.csv" "another name"
  ARGS -study uniform -pairs study -study_nonmortar upper:bottom -study_mortar lower:top -options_allow_unused)
mistake(study_memory        SAYS "-study_memory 4GB" "'4GB' is not" ARGS -study uniform -study_memory 4GB)

# --- probes and files ---
mistake(probe_outside       SAYS -probe_tip_at upper ARGS -probes tip -probe_tip_at 0.5,-0.5 -probe_tip_body upper)
mistake(probe_nowhere       SAYS -probe_tip_at missing ARGS -probes tip -probe_tip_body upper)
mistake(probe_of_no_body    SAYS "-probe_tip_body uper" "did you mean upper?" ARGS -probes tip -probe_tip_at 0,0 -probe_tip_body uper)
mistake(probe_unlisted      SAYS "-probe_tip_at 0,0" -probes ARGS -probe_tip_at 0,0)
mistake(output_in_file      SAYS -output boxes.opts ARGS -output ${here}/boxes.opts/result)
mistake(output_forbidden    SAYS -output /proc ARGS -output /proc/result)
mistake(output_format       SAYS -output_format "'vtk'" "xdmf, vtu" ARGS -output_format vtk)
mistake(summary_forbidden   SAYS -summary /proc ARGS -summary /proc/summary.json)
mistake(quiet_monitor       SAYS -monitor -quiet ARGS -quiet -monitor)
