/* fullsolver.h -- one linear system per active set at full size, and its convergence test. */
#ifndef MORTISE_FULLSOLVER_H
#define MORTISE_FULLSOLVER_H

#include "pdas/pdasimpl.h"

/* Roundoff of forces, relative to the diagonal times the displacements. */
#define FULLSOLVER_ROUNDING (16 * PETSC_MACHINE_EPSILON)

typedef struct {
  KSP       ksp;    /* referenced: a SNES destroys its own before what was kept with it */
  PC        pc;     /* of it */
  Mat       A;      /* A^ */
  Vec       free;   /* M */
  Vec       y, r;   /* the solution; b - A y */
  Vec       f, d;   /* unknown of the KSP, A^ d = f */
  PetscBool same;   /* M is what A^ was made for */
  PetscBool direct; /* the KSP only applies its preconditioner */
  PetscBool shell;  /* A^ is the preconditioner's own: no copy of A */
  PetscBool asked;  /* the KSP iterates with multigrid, with the convergence test of convergence.c */
  PetscReal rtol;   /* of the KSP, for the last solve of an inequality */
  PetscReal ritz;   /* the smallest Ritz value of all systems, 0 if there is none */
  /* of the present system, for the convergence test */
  Vec             rest;      /* M r */
  ActiveSolution *solution;  /* borrowed: the solution in progress */
  PetscReal       first;     /* |f|_D */
  PetscReal       reference; /* size of forces that the final residual is compared with, 0 until it is known */
  PetscReal       energy;    /* bound for the square of the final error in the energy norm */
  PetscReal       limit;     /* residual in the norm of the KSP at which the iterate is evaluated */
  PetscReal       before;    /* eta of the last rejected iterate */
  PetscReal       norm;      /* its residual in the norm of the KSP */
  PetscReal       begun;     /* the first residual in that norm */
  PetscReal       work;      /* of the hierarchy then */
  PetscBool       confirmed; /* an iterate has confirmed the set */
  PetscBool       done;      /* the last iterate was accepted */
  PetscBool       over;      /* a factorization would cost less */
} FullSolver;

/* Updates the smallest Ritz value of B A^, an upper bound on the smallest eigenvalue. Collective. [in] t -
   after an iteration of its KSP, or in it */
PetscErrorCode FullSolverUpdateRitz(FullSolver *t);

/* What a solution y is compared with. The residual must be small beside the forces in the bodies: prescribed
   displacements make a large f of small forces. The error must be small beside y in the energy norm, since
   residuals say little about smooth errors. Roundoff passes both tests. Costs a product. Collective.
   [out] work - overwritten;
   [in] first - |f|_D; [out] reference - size of forces; [out] energy - bound for the square of the error, or
   NULL */
PetscErrorCode FullSolverMeasure(ActiveSolver solver, Vec y, Vec work, PetscReal first, PetscReal *reference,
                                 PetscReal *energy);

/* Sets M and A^, for corrections without a solve. Collective. [in] fixed - [n]; [in] more - what the cycle of
   multigrid adds to A, or NULL */
PetscErrorCode FullSolverSetFixed(ActiveSolver solver, const PetscBool fixed[], Mat more);

/* Sets the convergence test of a KSP with multigrid. Collective. */
PetscErrorCode ConvergenceSetTest(ActiveSolver solver);
/* Restores the default test. Collective. */
PetscErrorCode ConvergenceUnsetTest(FullSolver *t);
/* Must be called before each solve of that KSP. Collective. [in] first - |f|_D; [in] solution - borrowed
   until the KSP returns: fixed, and y there, are read; the rest becomes that of the last evaluated iterate */
PetscErrorCode ConvergenceBegin(ActiveSolver solver, PetscReal first, ActiveSolution *solution);
/* Must be called after it: y and its residual become those of the last iterate. Collective. */
PetscErrorCode ConvergenceFinish(ActiveSolver solver);

#endif
