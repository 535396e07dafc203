/* pretension.h -- bodies that are tightened to a given force. */
#ifndef MORTISE_PRETENSION_H
#define MORTISE_PRETENSION_H

#include "solve/solver.h"

/* SolverSolve(); where scene->tighten, with the strain of every body with pretension at which its mean axial force is that given. Not
   finding it is not an error: the report says so. Collective. [in] solvability - of vi, or NULL; [in] guess - or NULL */
PetscErrorCode PretensionSolve(VI vi, Solvability solvability, Solver solver, Vec guess, Vec y, SolverReport *report);

#endif
