/* marking.h -- which cells are refined. */
#ifndef MORTISE_MARKING_H
#define MORTISE_MARKING_H

#include "result/estimate.h"

/* Marks the cells of largest eta_T^2, as many as hold a share of their sum (Dorfler 1996). Cells whose values differ by less than one per
   cent are marked together, so that symmetric scenes keep their symmetry and all numbers of ranks mark the same. Collective.
   [in] estimate - of the level; [out] marked - [num_cells], owned by the caller */
PetscErrorCode MarkingCreate(const Level *level, Estimate estimate, PetscReal share, PetscBool **marked);

#endif
