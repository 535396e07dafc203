/* pdasimpl.h -- what the parts of `pdas` share.

   Everything the iteration decides on lives on the bounded unknowns alone: their bounds, their values y, the forces
   r = b - A y that hold them there. How the other unknowns are eliminated is the business of an ActiveSolver, of which
   there are two: FullSolverCreate() works with the full matrix, SchurSolverCreate() with a dense Schur complement. */
#ifndef MORTISE_PDASIMPL_H
#define MORTISE_PDASIMPL_H

#include <stdint.h>
#include <petscsnes.h>
#include "base/compat.h"

/* The bounded unknowns and which of them are active (fixed at their bound). Distributed like y. */
typedef struct {
  MPI_Comm   comm;
  PetscInt   n, N;       /* bounded unknowns of this rank, of all */
  PetscInt   begin;      /* bounded unknowns of lower ranks */
  PetscInt   dof_begin;  /* first unknown of this rank */
  PetscInt  *dof;        /* which unknowns they are, global numbers, ascending [n] */
  PetscReal *upper;      /* [n] */
  PetscReal *diag;       /* A_ii > 0 [n] */
  PetscBool *active;     /* [n] */
  PetscInt   num_active; /* of all ranks */
} ActiveSet;

/* Finds the bounded unknowns (upper < infinity); nothing active. Collective. */
PetscErrorCode ActiveSetCreate(Vec upper, Mat A, ActiveSet *set);
PetscErrorCode ActiveSetDestroy(ActiveSet *set);
/* Takes values of bounded unknowns from a vector, or puts them there. Not collective. [in or out] values - [n] */
PetscErrorCode ActiveSetGather(const ActiveSet *set, Vec v, PetscReal values[]);
PetscErrorCode ActiveSetScatter(const ActiveSet *set, const PetscReal values[], Vec v);
/* Makes next the active set and counts what changes. Collective. [in] next - [n]; [out] changed - of all ranks */
PetscErrorCode ActiveSetReplace(ActiveSet *set, const PetscBool next[], PetscInt *changed);
/* The bounded unknowns of all ranks, on all of them. Collective. [out] C - owned by the caller [N] */
PetscErrorCode ActiveSetAll(const ActiveSet *set, PetscInt **C);
/* A number that tells sets apart. Collective. */
PetscErrorCode ActiveSetHash(const ActiveSet *set, uint64_t *hash);

/* The solution of one linear system, as far as the bounded unknowns see it. */
typedef struct {
  PetscBool  *fixed;      /* which of them were prescribed [n] */
  PetscReal  *y;          /* exactly the prescribed value where fixed [n] */
  PetscReal  *r;          /* b - A y, exactly 0 where not fixed [n] */
  PetscReal   size;       /* max |y| over all unknowns, to the order of magnitude: the scale of roundoff */
  PetscReal   eta;        /* residual of the rows that are not fixed, relative to the system's right-hand side */
  PetscReal   norm;       /* 2-norm of that residual */
  PetscInt    iterations; /* of the linear solver, in this system */
  const char *failure;    /* why there is no solution, or NULL; the same on all ranks */
} ActiveSolution;

PetscErrorCode ActiveSolutionCreate(const ActiveSet *set, ActiveSolution *solution);
PetscErrorCode ActiveSolutionDestroy(ActiveSolution *solution);
/* Whether the decision (eq. 10.1) with tolerances leaves the set as it is. Collective. */
PetscErrorCode ActiveSetHolds(const ActiveSet *set, const ActiveSolution *solution, PetscReal c, PetscBool *holds);
/* The decision (eq. 10.1) with tolerances, and how far the solution is from fulfilling all inequalities (2-norm, force).
   Collective. [in] c - of eq. 10.1; [out] changed - of all ranks */
PetscErrorCode ActiveSetUpdate(ActiveSet *set, const ActiveSolution *solution, PetscReal c, PetscInt *changed,
                               PetscReal *violation);

#define FAILURE_SINGULAR "the system is singular: do supports or contact hold every body?"
#define FAILURE_RESIDUAL                                                                                               \
  "the direct solver leaves a residual above -snes_rtol: is that too small, or is a body not held (nearly singular "   \
  "system)?"
#define FAILURE_MEMORY "the direct solver ran out of memory: try -mat_mumps_icntl_14 100, or -pc_type truncatedmg"
#define FAILURE_ITERATIVE                                                                                              \
  "the linear solver did not converge: try -pc_type cholesky, which does not iterate, or a larger -ksp_max_it"
#define FAILURE_COST "the iteration cost more than a factorisation"

/* One way to solve  y_i = value_i where fixed,  (A y - b)_i = 0 elsewhere.  All functions are collective. */
typedef struct _n_ActiveSolver *ActiveSolver;
struct _n_ActiveSolver {
  const ActiveSet *set;      /* borrowed */
  Mat              A;        /* borrowed */
  Vec              b;        /* borrowed */
  Vec              diag;     /* of A */
  PetscReal        rtol;     /* eta that is good enough in the end */
  PetscReal        target;   /* and now: not below rtol */
  PetscBool        inexact;  /* whether less accuracy costs less */
  PetscBool        factored; /* whether by a factorisation */
  /* where the error, not the residual, says when to stop: squares of |y - y*|_A */
  PetscReal error_reduction; /* part of the first one that is small enough, or 0 */
  PetscReal energy_decrease; /* before the first solve */
  PetscBool all_digits;      /* no iterate is to be looked at before */
  PetscReal first;           /* with that, of what the first solve began with; 0 before it */
  /* asked by an inexact solver that has reached its target, of an iterate: whether that set is still worth more digits. Then it lowers the target,
     and the solver goes on. NULL where nobody minds. [in] pdas - who asks it */
  PetscErrorCode (*holds)(ActiveSolver, const ActiveSolution *iterate, PetscBool *holds);
  void *pdas;
  void *data;
  /* [in] fixed, value - [n], values are read where fixed; [in,out] solution - created by the caller */
  PetscErrorCode (*solve)(ActiveSolver, const PetscBool fixed[], const PetscReal value[], ActiveSolution *solution);
  /* Another right-hand side, for the same matrix and bounds. [in] b - borrowed; [in] y - first guess */
  PetscErrorCode (*load)(ActiveSolver, Vec b, Vec y);
  /* The unknowns without bounds that go with the last solution; its r, eta and norm become those of the full system.
     [out] y */
  PetscErrorCode (*finish)(ActiveSolver, ActiveSolution *solution, Vec y);
  /* d = A_FF^-1 f for the last set, F the unknowns that were not fixed; of an iterative solver its preconditioner, B f.
     [in] f - 0 where fixed; [out] d - 0 where fixed; [out] alpha - the smallest Ritz value of B A_FF, 1 with a
     factorisation, 0 where it is not known */
  PetscErrorCode (*correct)(ActiveSolver, Vec f, Vec d, PetscReal *alpha);
  /* What there is to know of d = A_FF^-1 f for half the price; NULL for solvers that cannot. [in] f - 0 where fixed;
     [out] square - |d|_A^2; [out] felt - A d where fixed [n] */
  PetscErrorCode (*measure)(ActiveSolver, Vec f, PetscReal *square, PetscReal felt[]);
  PetscErrorCode (*destroy)(ActiveSolver);
};

/* At full size, rows and columns of fixed unknowns emptied, by the user's KSP. [in] y - first guess */
PetscErrorCode FullSolverCreate(const ActiveSet *set, Mat A, Vec b, Vec y, KSP ksp, PetscReal rtol,
                                ActiveSolver *solver);
/* Bounded unknowns up to which a dense factorisation per set (9e9 operations, half a second, and 216 MB) beats a sparse one. */
enum { ACTIVE_MAX_SCHUR = 3000 };

/* By one factorisation for all sets. [in] prefix - of MUMPS' options; [out] failure - why it cannot be, or NULL */
PetscErrorCode SchurSolverCreate(const ActiveSet *set, Mat A, Vec b, const char prefix[], PetscReal rtol,
                                 ActiveSolver *solver, const char **failure);
PetscErrorCode ActiveSolverDestroy(ActiveSolver *solver);

/* For the two of them. Collective: the common part of the constructors. */
PetscErrorCode ActiveSolverCreate(const ActiveSet *set, Mat A, Vec b, PetscReal rtol, ActiveSolver *solver);
/* Collective. [out] r - b - A y; [out] f - the same, 0 where fixed; [out] size - sqrt(f' diag(A)^-1 f): rows of
   different stiffness count alike */
PetscErrorCode ActiveSolverResidual(ActiveSolver solver, const PetscBool fixed[], Vec y, Vec r, Vec f, PetscReal *size);
/* Whether a residual of such a size is as good as digits can make it: below rtol of the reference, or what the last digit of y makes where
   that is still small beside the reference. Collective. */
PetscErrorCode ActiveSolverSuffices(ActiveSolver solver, Vec y, PetscReal size, PetscReal reference,
                                    PetscBool *suffices);
/* What the bounded unknowns see of y, r and f. Collective. [in,out] solution - fixed, and y where fixed, are there */
PetscErrorCode ActiveSolverRestrict(ActiveSolver solver, Vec y, Vec r, Vec f, ActiveSolution *solution);
/* r = b - A y, as if computed in twice the precision and rounded once; see residual.c. Collective. */
PetscErrorCode CompensatedResidual(Mat A, Vec b, Vec y, Vec r);
/* What such an error of a factorisation means, NULL for none. Not collective. */
const char *ActiveSolverFailureOfFactor(MatFactorError error);

/* Projected Newton method with a line search on the energy; see safeguard.c. */
typedef struct {
  PetscBool  on, settled; /* in charge; its set did not change, so that it may be the one */
  PetscReal *y, *r, *d;   /* feasible iterate, its forces, the step [n] */
  PetscBool *fixed, *all; /* the iterate's set; everything [n] */
} ProjectedNewton;

/* Begins at the last solution, clipped. Collective. */
PetscErrorCode ProjectedNewtonBegin(ProjectedNewton *newton, const ActiveSet *set, ActiveSolver solver,
                                    ActiveSolution *solution);
/* One step. Collective.
   [out] changed - of all ranks; [out] violation - as of ActiveSetUpdate(); solution->failure may be set */
PetscErrorCode ProjectedNewtonStep(ProjectedNewton *newton, ActiveSet *set, ActiveSolver solver,
                                   ActiveSolution *solution, PetscInt *changed, PetscReal *violation);
PetscErrorCode ProjectedNewtonEnd(ProjectedNewton *newton);

typedef enum { START_EMPTY, START_FULL, START_GAP, START_PREVIOUS, START_COUNT } PDASStart;

/* The type's context: what the user wants, */
typedef struct {
  PetscReal c;
  PDASStart start;
  PetscBool start_set, reduce, reduce_set;
  Vec       lower, upper;                     /* NULL without bounds */
  Vec       previous;                         /* of PDASSetStart(), or NULL */
  PetscReal error_reduction, energy_decrease; /* of PDASSetErrorReduction() */
  /* and what happened */
  PetscInt    max_it, iterations, linear_iterations;
  PetscInt   *changed; /* [max_it] */
  PetscInt    num_seen;
  uint64_t   *seen;   /* hashes of the sets that were solved for [max_it] */
  PetscReal   target; /* residual at which the next system is first looked at */
  PetscBool   converged, safeguarded, reduced;
  PetscReal   residual;   /* relative, of the last system */
  const char *failure;    /* why a system could not be solved, or NULL */
  PetscInt    num_active; /* of the present set */
  Vec         active;     /* 0/1, the final set */
  /* what the next solve can use again, where matrix and bounds stay the same */
  PetscBool    keep;
  ActiveSet    set;
  ActiveSolver solver; /* NULL if there is none */
  Vec          b;
} PDAS;

/* Makes the set to begin with, as iteration 0. Collective. [in] y - initial guess; [in] r - its forces b - A y */
PetscErrorCode PDASBegin(SNES snes, PDAS *pdas, ActiveSet *set, Vec y, Vec r);
/* From set to set until none changes; pdas->converged, or pdas->failure, or neither after max_it steps. Collective.
   [out] y - the last solution, unless there was a failure */
PetscErrorCode PDASIterate(SNES snes, PDAS *pdas, ActiveSet *set, ActiveSolver solver, Vec y);

/* The context of a SNES of type pdas. Not collective. */
PetscErrorCode PDASGet(SNES snes, PDAS **pdas);
/* Makes pdas->solver for pdas->set; pdas->failure tells if it cannot be had. Collective. [in] y - initial guess */
PetscErrorCode PDASChooseSolver(SNES snes, PDAS *pdas, Mat A, Vec b, Vec y);

/* Systems are solved until the error is small beside that of the start: |y - y*|_A^2 <= enough (gained + |y_0 - y*|_A^2), with multigrid.
   Collective. [in] gained - of the square, before y_0 */
PetscErrorCode PDASSetErrorReduction(SNES snes, PetscReal error_reduction, PetscReal energy_decrease);
/* The same of one solver, with multigrid. Not collective. */
PetscErrorCode ConvergenceSetErrorReduction(ActiveSolver solver, PetscReal error_reduction, PetscReal energy_decrease);

/* What the last solve used, its last set being its own, if it was kept (PDASSetKeep()) and found the solution. Borrowed, NULL if
   there is none. Not collective. */
PetscErrorCode PDASGetSolver(SNES snes, ActiveSolver *solver);
/* A solver of the kind that pdas would use, or of the KSP alone where the SNES is of another type. Collective.
   [out] failure - why it cannot be had, or NULL; solver is to be destroyed all the same */
PetscErrorCode PDASCreateSolver(SNES snes, const ActiveSet *set, Mat A, Vec b, PetscReal rtol, ActiveSolver *solver,
                                const char **failure);

#endif
