/* marking.h -- which cells are refined. */
#ifndef MORTISE_MARKING_H
#define MORTISE_MARKING_H

#include "result/estimate.h"

/* Marks the cells of largest eta_T^2, as many as hold a share of their sum (Dorfler 1996). Where that makes less than an eighth more of them, as
   on a fine mesh whose error is at a few places, and eta is below a tenth of the solution, the same is done once more, as if those were
   halved already with a quarter of their eta_T^2 left: a cell may get two marks. Cells whose values differ by less than one per cent are
   marked together, so that symmetric scenes keep their symmetry and all numbers of ranks mark the same. Collective.
   [in] estimate - of the level; [out] marked - how often edges are to be halved [num_cells], owned by the caller */
PetscErrorCode MarkingCreate(const Level *level, Estimate estimate, PetscReal share, PetscInt **marked);

#endif
