/* costmodel.h -- when a factorization replaces an iteration; internal (eq. 14.5). */
#ifndef MORTISE_COSTMODEL_H
#define MORTISE_COSTMODEL_H

#include "multigrid/hierarchy.h"
#include "problem/vi.h"

/* All costs are in products with the finest matrix, as Hierarchy counts its work: the same on all ranks, and
   on any machine. */
typedef struct {
  VI        vi;        /* of the finest level, borrowed */
  Hierarchy hierarchy; /* borrowed */
  PetscBool on;        /* whether a factorization may replace the iteration */
  PetscBool over;      /* whether it must */
  PetscBool found; /* whether the inequality has been solved once with a proximal term: then the contacts are found */
  PetscBool asked; /* whether the next two are known */
  PetscReal once, set; /* what a factorization takes once, and for each set */
} CostModel;

/* Sets this cost model as the cost test of a hierarchy. It predicts the cost of a factorization once the
   iteration has cost enough to pay for that, and compares afterwards. Not collective. [in] model - must not
   be moved */
PetscErrorCode CostModelSet(CostModel *model, VI vi, Hierarchy hierarchy);
/* What a factorization takes for as many sets as there have been; 0 without a prediction. Not collective. */
PetscReal CostModelPredicted(const CostModel *model);

/* Products with the matrix in the time of so many operations of a factorization. Collective. */
PetscErrorCode CostModelUnit(VI vi, PetscReal *operations);
/* Operations for each set where one factorization serves num unknowns with bounds. Not collective. */
PetscReal CostModelPerSet(PetscInt num);

#endif
