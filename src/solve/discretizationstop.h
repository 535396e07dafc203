/* discretizationstop.h -- stopping at the discretisation error; internal (eq. 14.7). */
#ifndef MORTISE_DISCRETIZATIONSTOP_H
#define MORTISE_DISCRETIZATIONSTOP_H

#include "solve/solvercontext.h"

/* The part of |u_h - u_2h|_K^2 that the square of the solver's error may be. Not collective. */
PetscReal DiscretizationStopPart(const Scene scene);
/* Sets the error reduction, before a solve by pdas with levels. Collective. [in] energy_decrease - of
   NestedIterationStart() */
PetscErrorCode DiscretizationStopSet(const SolverContext *context, PetscReal energy_decrease);
/* After the solve and its error bound: continues until the bound is small enough. Collective. [in,out] y;
   [in,out] report - converged only if the bound is small enough */
PetscErrorCode DiscretizationStopConfirm(SolverContext *context, Vec y, SolverReport *report);

#endif
