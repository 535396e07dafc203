/* activeprediction.h -- which set a level's solution will have, before any system is solved; internal (eq. 14.2). */
#ifndef MORTISE_ACTIVEPREDICTION_H
#define MORTISE_ACTIVEPREDICTION_H

#include "multigrid/hierarchy.h"

/* Projected steps from y, and cycles of multigrid between them. Collective.
   [in] grid - the level; [in] pc - multigrid on it and all below, or NULL for steps alone; [in,out] y - with eliminated unknowns at their
   values; feasible afterwards; [in,out] active - 1 or 0: the set that they end with, as it was where they cannot tell; [out] gained - twice the
   energy */
PetscErrorCode ActivePredictionApply(Hierarchy hierarchy, const HierarchyLevel *level, PC pc, Vec y, Vec active,
                                     PetscReal *gained);
/* The set of y: 1 where an unknown is at its bound with a force on it, else 0. Collective. [out] active */
PetscErrorCode ActivePredictionGetActive(Hierarchy hierarchy, const HierarchyLevel *level, Vec y, Vec active);

#endif
