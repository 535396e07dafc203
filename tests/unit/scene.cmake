mortise_unit(scene LAYER scene RANKS 1 2)
mortise_unit(dimension LAYER scene RANKS 1 2 FAULTS)
target_compile_definitions(test_dimension PRIVATE MESHES="${CMAKE_CURRENT_SOURCE_DIR}/unit/meshes")
