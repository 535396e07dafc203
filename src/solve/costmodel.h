/* costmodel.h -- when a factorization replaces an iteration; internal (eq. 14.5). */
#ifndef MORTISE_COSTMODEL_H
#define MORTISE_COSTMODEL_H

#include "multigrid/hierarchy.h"
#include "problem/vi.h"

/* All costs are in products with the finest matrix, as Hierarchy counts its work. They are the same on all
   ranks and on any machine. */
typedef struct {
  VI        vi;        /* of the finest level, borrowed */
  Hierarchy hierarchy; /* borrowed */
  PetscBool on;        /* whether a factorization may replace the iteration */
  PetscBool over;      /* whether it does */
  PetscBool found;     /* whether the inequality has been solved once with a proximal term */
  PetscBool asked;     /* whether the next two are known */
  PetscReal once, set; /* predicted cost: of the factorization, and of each active set with it */
} CostModel;

/* Sets this cost model as the cost test of a hierarchy. Once the iteration has cost much more than a
   prediction, the test predicts the cost of a factorization; from then on it compares. Not collective.
   [in] model - must not be moved */
PetscErrorCode CostModelSet(CostModel *model, VI vi, Hierarchy hierarchy);
/* Predicted cost of a factorization with as many active sets as so far; 0 without a prediction.
   Not collective. */
PetscReal CostModelPredicted(const CostModel *model);

/* Operations of a factorization in the time of one product with K. Collective. */
PetscErrorCode CostModelUnit(VI vi, PetscReal *operations);
/* Operations for each active set, where one factorization serves all sets of num unknowns with bounds.
   Not collective. */
PetscReal CostModelPerSet(PetscInt num);

#endif
