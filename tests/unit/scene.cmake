mortise_unit(scene LAYER scene RANKS 1 2)
mortise_unit(dimension LAYER scene RANKS 1 2 FAULTS DEFINES MESHES="${CMAKE_CURRENT_SOURCE_DIR}/unit/meshes")
