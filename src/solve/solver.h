/* solver.h -- the solver of one inequality: a SNES with defaults by size, the error bound, the
   cross-check. */
#ifndef MORTISE_SOLVER_H
#define MORTISE_SOLVER_H

#include "problem/vi.h"
#include "rigid/solvability.h"
#include <petscsnes.h>

enum { SOLVER_MAX_HISTORY = 512 }; /* largest number of iterations whose changes the report lists */

/* Bound on |u - u*|_K of a displacement u, in the user's units (root of work); u* solves the inequality (eq.
   11.2). */
typedef struct {
  PetscReal value;     /* NAN if not known */
  PetscBool estimated; /* by Ritz values of an iterative solver, not by a factorization */
} EnergyBound;

/* The cost of one linear solve with the final active set, from its preconditioner to its solution. */
typedef struct {
  PetscBool done;       /* whether it was requested and solved */
  PetscReal seconds;    /* of the slowest rank, on the wall */
  PetscReal work;       /* as in SolverReport */
  PetscInt  iterations; /* of an iterative solver */
} LinearReference;

/* How one solve went; the same on all ranks. */
typedef struct {
  char      type[64];        /* SNES type */
  char      linear[128];     /* what solved the linear systems, in words */
  char      ksp[64], pc[64]; /* the same, types of PETSc */
  PetscBool converged;
  char      reason[512]; /* reason of a failure, as a sentence; "" when converged */
  PetscInt  iterations, active, linear_iterations;
  PetscInt  num_changed,
      changed[SOLVER_MAX_HISTORY]; /* per iteration; num_changed = 0 for types without this information */
  PetscBool      safeguarded;
  FrictionReport friction;        /* zero without friction */
  PetscReal      linear_residual; /* relative, of the last system */
  PetscReal      work; /* products with matrices of all levels, in products with the finest; 0 without levels */
  PetscReal      predicted_cost; /* predicted cost of a factorization, in the same unit; 0 without a prediction */
  PetscBool      gave_way;       /* whether a factorization replaced the iteration */
  PetscInt       proximal_steps; /* proximal point steps (eq. 12.6); 1 without a proximal term */
  PetscBool      slid;           /* friction did not hold bodies, which slid on and on */
  EnergyBound    bound;
  PetscReal discretisation; /* estimate of |u - u_h|_K by a coarser mesh; NAN unless it stops the solver (eq. 14.7) */

  PetscReal       seconds;   /* of the slowest rank, on the wall, from the levels of multigrid to the bound */
  LinearReference reference; /* of SolverSolveLinear() */
} SolverReport;

/* Comparison of two solutions of the same VI. */
typedef struct {
  PetscBool    done, agree;
  SolverReport other;
  PetscInt     active_difference;
  PetscReal    displacement_difference; /* max |du| / max |u| */
} CrossCheck;

/* The solver of one inequality. Where the scene asks for it, factors and multigrid levels stay from one solve
   to the next. */
typedef struct _n_Solver *Solver;

/* Not collective. [in] vi - borrowed for as long as the solver lives; [in] solvability - of vi, borrowed;
   NULL where supports hold all bodies;
   [out] solver - owned by the caller */
PetscErrorCode SolverCreate(VI vi, Solvability solvability, Solver *solver);
PetscErrorCode SolverDestroy(Solver *solver);
/* Lets a solver have the multigrid levels of another one on the same mesh when it had one level less.
   Collective. [in,out] older - without levels afterwards; [in,out] vi - what it has solved; taken over with
   the levels, NULL then */
PetscErrorCode SolverExtend(Solver solver, Solver older, VI *vi);
/* The loads, given displacements and gaps of vi have changed, and its solvability: what was kept serves them.
   Collective. */
PetscErrorCode SolverUpdate(Solver solver);
/* Solves by -snes_type (default pdas); progress lines where the scene wants them. Not converging is not an
   error: the report says so. Collective.
   [in] guess - displacement to begin with (ghosted, dim per node), which changes the work and not the answer;
   or NULL
   [out] y - created by the caller in the layout of vi->b */
PetscErrorCode SolverSolve(Solver solver, Vec guess, Vec y, SolverReport *report);
/* Solves once more with the active set of the solution y, by the same linear solver, from zero with a new
   setup; the seconds belong to no stage. Collective.
   [in,out] report - of SolverSolve(); its reference is set */
PetscErrorCode SolverSolveLinear(Solver solver, Vec y, SolverReport *report);
/* Solves by the other of pdas and vinewtonrsls and compares. Collective. */
PetscErrorCode SolverCrossCheck(Solver solver, Vec y, const SolverReport *report, CrossCheck *check);
/* Prints the choice of the linear solver and its reason (part of -scene_view). Collective. */
PetscErrorCode SolverView(Solver solver);

#endif
