foreach(module support supportsolid pieces meshfaults)
  mortise_unit(${module} LAYER support RANKS 1 3 DEFINES MESHES="${CMAKE_CURRENT_SOURCE_DIR}/unit/meshes")
endforeach()
mortise_unit(rigid LAYER support RANKS 1 3)
