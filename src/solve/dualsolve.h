/* dualsolve.h -- linear problems with the matrix of an inequality and its final active set. */
#ifndef MORTISE_DUALSOLVE_H
#define MORTISE_DUALSOLVE_H

#include "solve/solver.h"

/* A_FF z_F = b_F, z = 0 in active and fixed unknowns; F are all others. With the factors, or the levels, of
   the last solve as far as the solver has kept them. Collective.
   [in] report - of SolverSolve();
   [in] y - its solution; [in] b - right-hand sides, 0 in fixed unknowns [num];
   [out] z - created by the caller [num]; [out] solved - whether all are */
PetscErrorCode DualSolve(Solver solver, const SolverReport *report, Vec y, PetscInt num, const Vec b[], Vec z[],
                         PetscBool *solved);

#endif
