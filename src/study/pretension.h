/* pretension.h -- bodies with pretension: their strain along the axis for a given force. */
#ifndef MORTISE_PRETENSION_H
#define MORTISE_PRETENSION_H

#include "solve/solver.h"

/* SolverSolve(); with scene->tighten it also finds the strain of each body with pretension, so that its mean
   axial force is the given one. If it finds none, the report has the reason; that is no error. Collective.
   [in] solvability - of vi, or NULL; [in] guess - initial guess of the displacement, or NULL */
PetscErrorCode PretensionSolve(VI vi, Solvability solvability, Solver solver, Vec guess, Vec y, SolverReport *report);

#endif
