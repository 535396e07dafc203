/* sharedcells.h -- bodies of the same cells of one file: -<body>_mesh_region was forgotten.
   Nothing is collective. */
#ifndef MORTISE_SHAREDCELLS_H
#define MORTISE_SHAREDCELLS_H

#include "bodies/meshfile.h"

/* Checks that a body has no cell of its file in common with an earlier body in the same place.
   [out] sentence - untouched if so [MESH_SENTENCE] */
PetscErrorCode SharedCellsCheck(Scene scene, PetscInt body, const MeshFile file, char sentence[]);

#endif
