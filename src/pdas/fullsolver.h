/* fullsolver.h -- one system of an active set at full size, and when an iteration for it has done enough. */
#ifndef MORTISE_FULLSOLVER_H
#define MORTISE_FULLSOLVER_H

#include "pdas/pdasimpl.h"

/* What rounding leaves of the forces that displacements alone would need. */
#define FULLSOLVER_ROUNDING (16 * PETSC_MACHINE_EPSILON)

typedef struct {
  KSP       ksp;    /* referenced: a SNES destroys its own before what was kept with it */
  PC        pc;     /* of it */
  Mat       A;      /* A^ */
  Vec       free;   /* M */
  Vec       y, r;   /* the solution; b - A y */
  Vec       f, d;   /* what the KSP solves for, A^ d = f */
  PetscBool same;   /* M is what A^ was made for */
  PetscBool direct; /* the KSP only applies its preconditioner */
  PetscBool shell;  /* A^ is the preconditioner's own: no copy of A */
  PetscBool asked;  /* the KSP iterates with multigrid, and it is told here when to end */
  PetscReal rtol;   /* of the KSP, for the last solve of an inequality */
  PetscReal ritz;   /* the smallest Ritz value of all systems, 0 if there is none */
  /* of the present system, where it is asked */
  Vec             rest;      /* M r */
  ActiveSolution *solution;  /* borrowed: what is known of it */
  PetscReal       first;     /* |f|_D */
  PetscReal       reference; /* what the residual is to be small beside in the end, 0 as long as that is not known */
  PetscReal       energy;    /* what the square of the error is to come below in the end */
  PetscReal       limit;     /* residual in the KSP's norm at which an iterate is worth a look */
  PetscReal       before;    /* eta of one that was not good enough, */
  PetscReal       norm;      /* and its residual in the KSP's norm */
  PetscBool       done;      /* the last one was */
  PetscBool       over;      /* a factorisation would cost less */
} FullSolver;

/* The smallest eigenvalues of B A^: what iterations have seen of them, from above. Collective. [in] t - after an iteration of its KSP, or in it */
PetscErrorCode FullSolverUpdateRitz(FullSolver *t);

/* Hands the test of a KSP with multigrid over to what is below. Collective. */
PetscErrorCode ConvergenceSetTest(ActiveSolver solver);
/* Gives it its own test back. Collective. */
PetscErrorCode ConvergenceUnsetTest(FullSolver *t);
/* Before each call of that KSP. Collective. [in] first - |f|_D; [in] solution - borrowed until the KSP returns: fixed, and y there, are read, all
   else is that of the last iterate that was looked at */
PetscErrorCode ConvergenceBegin(ActiveSolver solver, PetscReal first, ActiveSolution *solution);
/* After it: y and its residual are those of the last iterate, whether the test has seen it or not. Collective. */
PetscErrorCode ConvergenceFinish(ActiveSolver solver);

#endif
