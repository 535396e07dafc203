/* coarsestiffness.h -- the stiffness of a coarser level as P'K P. */
#ifndef MORTISE_COARSESTIFFNESS_H
#define MORTISE_COARSESTIFFNESS_H

#include "level/level.h"

/* Collective.
   [in] K - of the finer level (stiffness.h); [in] P - prolongation of displacements; [in] nodal - of node
   values, if P has it for each component and fine cells are parts of coarse ones of the same rank, or NULL;
   [out] product - as of stiffness.h, owned by the caller */
PetscErrorCode CoarseStiffnessCreate(Level *coarse, Mat K, Mat P, Mat nodal, Mat *product);

#endif
