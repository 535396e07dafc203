# Every scene that is shipped.
file(GLOB scenes CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/options/*.opts)
foreach(path IN LISTS scenes)
  get_filename_component(shipped ${path} NAME_WE)
  mortise_scene_test(${shipped} CHECK same.py LABELS cross mpi)
endforeach()
