/* boxparts.h -- boxes of many cells, of which each rank makes its own. */
#ifndef MORTISE_BOXPARTS_H
#define MORTISE_BOXPARTS_H

#include "refinement/curves.h"

/* Whether each rank makes its part of the mesh: for boxes of many cells.
   [in] coarser - number of coarser levels */
PetscBool BoxPartsWanted(Scene scene, PetscInt coarser, PetscMPIInt num_ranks);
/* The mesh of all boxes, made by parts. Collective. User errors: a side that does not exist.
   [out] curves - none */
PetscErrorCode BoxPartsCreate(Scene scene, PetscInt coarser, DM *dm, Curves *curves);

#endif
