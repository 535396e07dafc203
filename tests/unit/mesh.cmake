foreach(module mesh meshsolid level secondorder curvedfiles support partition meshfaults)
  mortise_unit(${module} ROOMS base kernel mesh RANKS 1 2 3 4)
  target_compile_definitions(test_${module} PRIVATE MESHES="${CMAKE_CURRENT_SOURCE_DIR}/unit/meshes")
endforeach()
