/* activeprediction.h -- the active set of a level, predicted before any system is solved; internal (eq.
   14.2). */
#ifndef MORTISE_ACTIVEPREDICTION_H
#define MORTISE_ACTIVEPREDICTION_H

#include "multigrid/hierarchy.h"

/* Predicts the active set by projected steps from y and multigrid cycles between them. Collective.
   [in] pc - multigrid on the level and all below, or NULL: steps alone; [in,out] y - fixed unknowns have
   their values; feasible afterwards; [in,out] active - 1 or 0, unchanged where the prediction does not apply;
   [out] energy_decrease - twice the decrease of the energy */
PetscErrorCode ActivePredictionApply(Hierarchy hierarchy, const HierarchyLevel *level, PC pc, Vec y, Vec active,
                                     PetscReal *energy_decrease);
/* The same where the diagonal is no smoother and its steps predict nothing: cycles beyond the bounds and back
   onto them. Cycles within the bounds have no descent where many unknowns reach them. Collective.
   [in] pc - not NULL; [in] kept - whether the first cycle has the present factors of pc, of the set of
   another load step; [in,out] y, active - as above */
PetscErrorCode ActivePredictionBeyond(Hierarchy hierarchy, const HierarchyLevel *level, PC pc, PetscBool kept, Vec y,
                                      Vec active);
/* The same without a coarser mesh. One cycle for the initial set goes beyond the bounds and back onto them.
   Others follow until the set hardly changes. Collective.
   [in] pc - multigrid on the level; [in] floats - whether contact alone holds a body;
   [in,out] y - feasible; fixed unknowns have their values; [in,out] active - 1 or 0 */
PetscErrorCode ActivePredictionStart(Hierarchy hierarchy, const HierarchyLevel *level, PC pc, PetscBool floats, Vec y,
                                     Vec active);
/* The set of y: 1 where an unknown is at its bound with a force on it, else 0. Collective. [out] active */
PetscErrorCode ActivePredictionGetActive(Hierarchy hierarchy, const HierarchyLevel *level, Vec y, Vec active);

#endif
