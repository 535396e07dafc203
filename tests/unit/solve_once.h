/* solve_once.h -- one solve of an inequality, by a solver of its own. */
#ifndef MORTISE_TEST_SOLVE_ONCE_H
#define MORTISE_TEST_SOLVE_ONCE_H

#include "solve/solver.h"

static PetscErrorCode SolveOnce(VI vi, Solvability solvability, Vec guess, Vec y, SolverReport *report)
{
  PetscErrorCode error;
  Solver         solver;

  PetscFunctionBeginUser;
  PetscCall(SolverCreate(vi, solvability, &solver));
  error = SolverSolve(solver, guess, y, report); // may be a user error that the test expects
  PetscCall(SolverDestroy(&solver));
  PetscFunctionReturn(error);
}

#endif
