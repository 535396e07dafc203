# Every folder with a scene.opts is a case: its tables come from independent.py, never from mortise.
file(GLOB references CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/reference/*/scene.opts)
foreach(path IN LISTS references)
  get_filename_component(folder ${path} DIRECTORY)
  get_filename_component(case ${folder} NAME)
  mortise_scene_test(${case} SCENE ${case}/scene CHECK compare.py RANKS 1 3 LABELS regression)
endforeach()
foreach(case plates_mixed plates_mixed_21 plates_vertices_2 rings_2 rubber rubber_2 rubber_triangles_2) # FIELDS in tables.py
  mortise_scene_test(fields_${case} SCENE ${case}/scene CHECK fields.py RANKS 1 3 LABELS regression)
endforeach()

# Scenes put together at random, whose numbers begin at the last word of the title.
foreach(first 0 12 24 36)
  set(long)
  if(first GREATER 0)
    set(long LONG)
  endif()
  mortise_scene_test(scatter_${first} ${long} OWN_RUNS SCENE plates_quads/scene CHECK scatter.py RANKS 1 LABELS regression ARGS -title "Random scenes from ${first}")
endforeach()
mortise_scene_test(scatter_ranks LONG OWN_RUNS SCENE plates_quads/scene CHECK scatter.py RANKS 3 LABELS regression ARGS -title "Random scenes from 48")
mortise_scene_test(scatter_space OWN_RUNS SCENE plates_quads/scene CHECK scatter_space.py RANKS 1 LABELS regression ARGS -title "Random scenes from 0")
mortise_scene_test(scatter_space_ranks LONG OWN_RUNS SCENE plates_quads/scene CHECK scatter_space.py RANKS 3 LABELS regression ARGS -title "Random scenes from 40")

# Random scenes of nearly incompressible bodies.
mortise_scene_test(scatter_rubber OWN_RUNS SCENE plates_quads/scene CHECK scatter_rubber.py RANKS 1 LONG_RANKS 3 LABELS regression ARGS -title "Random scenes from 1")

# The tables are what independent.py computes from the scenes. Nothing of the program is in it.
if(MORTISE_TEST_LONG)
  add_test(NAME reference.origin COMMAND ${MORTISE_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/independent.py --check)
  set_tests_properties(reference.origin PROPERTIES LABELS "reference;regression" TIMEOUT 300 ENVIRONMENT "${MORTISE_TEST_ENVIRONMENT}")
endif()
