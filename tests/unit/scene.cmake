mortise_unit(scene LAYER scene RANKS 1 2)
mortise_unit(peek LAYER scene RANKS 1 2 FAULTS)
target_compile_definitions(test_peek PRIVATE MESHES="${CMAKE_CURRENT_SOURCE_DIR}/unit/meshes")
