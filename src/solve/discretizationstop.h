/* discretizationstop.h -- stopping at the discretisation error; internal (eq. 14.7). */
#ifndef MORTISE_DISCRETIZATIONSTOP_H
#define MORTISE_DISCRETIZATIONSTOP_H

#include "solve/solvercontext.h"

/* What of |u_h - u_2h|_K^2 the square of the solver's error may be. Not collective. */
PetscReal DiscretizationStopPart(const Scene scene);
/* Before the solve, pdas with levels. Collective. [in] gained - as of NestedIterationStart() */
PetscErrorCode DiscretizationStopSet(const SolverContext *context, PetscReal energy_decrease);
/* After it, and after the bound of its error: goes on where that is not small enough. Collective.
   [in,out] y; [in,out] report - converged only if it is in the end */
PetscErrorCode DiscretizationStopConfirm(SolverContext *context, Vec y, SolverReport *report);

#endif
