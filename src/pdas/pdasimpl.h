/* pdasimpl.h -- what the files of `pdas` share.

   The iteration works on the bounded unknowns alone: their bounds, their values y, and the forces r = b - A y
   on them. An ActiveSolver eliminates the other unknowns. FullSolverCreate() uses the full matrix,
   SchurSolverCreate() a dense Schur complement. */
#ifndef MORTISE_PDASIMPL_H
#define MORTISE_PDASIMPL_H

#include <stdint.h>
#include <petscsnes.h>
#include "base/compat.h"
#include "pdas/friction.h"

/* The bounded unknowns and which of them are active (fixed at their bound). Distributed like y. */
typedef struct {
  MPI_Comm   comm;
  PetscInt   n, N;       /* bounded unknowns of this rank, of all */
  PetscInt   begin;      /* bounded unknowns of lower ranks */
  PetscInt   dof_begin;  /* first unknown of this rank */
  PetscInt  *dof;        /* which unknowns they are, global numbers, ascending [n] */
  PetscReal *upper;      /* [n] */
  PetscReal *diag;       /* A_ii > 0 [n] */
  PetscReal *area;       /* of ActiveSetSetAreas() [n], or NULL */
  PetscBool *active;     /* [n] */
  PetscInt   num_active; /* of all ranks */
} ActiveSet;

/* Finds the bounded unknowns (upper < infinity); nothing active. Collective. */
PetscErrorCode ActiveSetCreate(Vec upper, Mat A, ActiveSet *set);
/* The same with the tangents of a law of friction, whose bounds are infinite. Collective. */
PetscErrorCode ActiveSetCreateWithTangents(Vec upper, Mat A, const FrictionLaw *law, ActiveSet *set);
/* Areas of all bounded unknowns. Not collective. */
PetscErrorCode ActiveSetSetAreas(ActiveSet *set, Vec areas);
PetscErrorCode ActiveSetDestroy(ActiveSet *set);
/* Gets values of bounded unknowns from a vector, or sets them. Not collective. [in or out] values - [n] */
PetscErrorCode ActiveSetGather(const ActiveSet *set, Vec v, PetscReal values[]);
PetscErrorCode ActiveSetScatter(const ActiveSet *set, const PetscReal values[], Vec v);
/* Replaces the active set and counts changes. Collective. [in] next - [n]; [out] changed - of all ranks */
PetscErrorCode ActiveSetReplace(ActiveSet *set, const PetscBool next[], PetscInt *changed);
/* The bounded unknowns of all ranks, on all of them. Collective. [out] C - owned by the caller [N] */
PetscErrorCode ActiveSetAll(const ActiveSet *set, PetscInt **C);
/* A hash of the set. Collective. */
PetscErrorCode ActiveSetHash(const ActiveSet *set, uint64_t *hash);

/* The solution of one linear system on the bounded unknowns. */
typedef struct {
  PetscBool  *fixed;      /* which of them were fixed [n] */
  PetscReal  *y;          /* exactly the prescribed value where fixed [n] */
  PetscReal  *r;          /* b - A y, exactly 0 where not fixed [n] */
  PetscReal   size;       /* max |y| over all unknowns, to the order of magnitude: scale of roundoff */
  PetscReal   eta;        /* residual of the free rows, relative to the right-hand side of the system */
  PetscReal   norm;       /* 2-norm of that residual */
  PetscInt    iterations; /* of the linear solver, in this system */
  const char *failure;    /* reason of a failure, or NULL; the same on all ranks */
} ActiveSolution;

/* Not collective. [out] solution - without values; to be destroyed by ActiveSolutionDestroy() */
PetscErrorCode ActiveSolutionCreate(const ActiveSet *set, ActiveSolution *solution);
PetscErrorCode ActiveSolutionDestroy(ActiveSolution *solution);
/* Whether the active set test (eq. 10.1) with tolerances leaves the set unchanged. Collective. */
PetscErrorCode ActiveSetHolds(const ActiveSet *set, const ActiveSolution *solution, PetscReal c, PetscBool *holds);
/* Applies the active set test (eq. 10.1) with tolerances; violation is the 2-norm of what is left of the
   inequalities, as forces. Collective. [in] c - of eq. 10.1; [out] changed - of all ranks */
PetscErrorCode ActiveSetUpdate(ActiveSet *set, const ActiveSolution *solution, PetscReal c, PetscInt *changed,
                               PetscReal *violation);

#define FAILURE_SINGULAR "the system is singular: do supports or contact hold every body?"
#define FAILURE_RESIDUAL                                                                                               \
  "the direct solver leaves a residual above -snes_rtol: is that too small, or is a body not held (nearly singular "   \
  "system)?"
#define FAILURE_MEMORY "the direct solver ran out of memory: try -mat_mumps_icntl_14 100, or -pc_type truncatedmg"
#define FAILURE_ITERATIVE                                                                                              \
  "the linear solver did not converge: try -pc_type cholesky, which does not iterate, or a larger -ksp_max_it"
#define FAILURE_COST "the iteration cost more than a factorization"

/* A solver of y_i = value_i where fixed, (A y - b)_i = 0 elsewhere. All functions are collective. */
typedef struct _n_ActiveSolver *ActiveSolver;
struct _n_ActiveSolver {
  const ActiveSet *set;      /* borrowed */
  Mat              A;        /* borrowed */
  Vec              b;        /* borrowed */
  Vec              diag;     /* of A */
  PetscReal        rtol;     /* eta required in the end */
  PetscReal        target;   /* eta required now: not below rtol */
  PetscBool        inexact;  /* whether lower accuracy costs less */
  PetscBool        factored; /* whether it is a factorization */
  /* for stopping by the error instead of the residual: squares of |y - y*|_A */
  PetscReal error_reduction; /* required reduction of the initial error, or 0 */
  PetscReal energy_decrease; /* decrease of the error before the first solve */
  PetscBool all_digits;      /* iterates are not evaluated before the required reduction */
  PetscReal first;           /* initial error, with energy_decrease; 0 before the first solve */
  /* An inexact solver calls this at its target accuracy, with an iterate: does the set still hold? If so it
     lowers the target, and the solver continues. Optional, may be NULL. [in] pdas - for the callback */
  PetscErrorCode (*holds)(ActiveSolver, const ActiveSolution *iterate, PetscBool *holds);
  void *pdas;
  void *data;
  /* [in] fixed, value - [n], values are read where fixed; [in,out] solution - created by the caller */
  PetscErrorCode (*solve)(ActiveSolver, const PetscBool fixed[], const PetscReal value[], ActiveSolution *solution);
  /* A new right-hand side for the same matrix and bounds. [in] b - borrowed; [in] y - initial guess */
  PetscErrorCode (*load)(ActiveSolver, Vec b, Vec y);
  /* All unknowns of the last solution; its r, eta and norm become those of the full system. [out] y */
  PetscErrorCode (*finish)(ActiveSolver, ActiveSolution *solution, Vec y);
  /* d = A_FF^-1 f for the last set, F the unknowns that were not fixed; of an iterative solver its
     preconditioner, B f.
     [in] f - 0 where fixed;
     [out] d - 0 where fixed; [out] alpha - the smallest Ritz value of B A_FF, 1 with a factorization, 0 where
     it is not known */
  PetscErrorCode (*correct)(ActiveSolver, Vec f, Vec d, PetscReal *alpha);
  /* Norm and reactions of d = A_FF^-1 f for half the cost; NULL if the solver cannot. [in] f - 0 where fixed;
     [out] square - |d|_A^2; [out] felt - A d where fixed [n] */
  PetscErrorCode (*measure)(ActiveSolver, Vec f, PetscReal *square, PetscReal felt[]);
  PetscErrorCode (*destroy)(ActiveSolver);
};

/* The solver at full size, with rows and columns of fixed unknowns emptied, by the user's KSP. Collective.
   [in] set, A, b - borrowed; [in] y - initial guess; [in] rtol - required eta */
PetscErrorCode FullSolverCreate(const ActiveSet *set, Mat A, Vec b, Vec y, KSP ksp, PetscReal rtol,
                                ActiveSolver *solver);
/* Bounded unknowns up to which a dense factorization per set (9e9 operations, half a second, and 216 MB) is
   cheaper than a sparse one. */
enum { ACTIVE_MAX_SCHUR = 3000 };

/* The solver by one factorization for all sets. Collective.
   [in] set, A, b - borrowed; [in] prefix - of MUMPS' options; [in] rtol - required eta;
   [out] failure - reason, or NULL */
PetscErrorCode SchurSolverCreate(const ActiveSet *set, Mat A, Vec b, const char prefix[], PetscReal rtol,
                                 ActiveSolver *solver, const char **failure);
/* Of such a solver: S and g of the reduced problem, and values of its unknowns to and from the first rank.
   Collective.
   [out] S, g - borrowed, of the first rank, NULL on others; [in,out] all - of the first rank, else NULL; own
   - [set->n] */
PetscErrorCode SchurSolverGetReduced(ActiveSolver solver, PetscScalar **S, PetscReal **g);
PetscErrorCode SchurSolverGather(ActiveSolver solver, const PetscReal own[], PetscReal all[]);
PetscErrorCode SchurSolverScatter(ActiveSolver solver, const PetscReal all[], PetscReal own[]);
PetscErrorCode ActiveSolverDestroy(ActiveSolver *solver);

/* The common part of the constructors. Collective. */
PetscErrorCode ActiveSolverCreate(const ActiveSet *set, Mat A, Vec b, PetscReal rtol, ActiveSolver *solver);
/* r = b - A y; f = r, 0 where fixed; size = sqrt(f' diag(A)^-1 f), which weighs rows of different stiffness
   alike. Collective. */
PetscErrorCode ActiveSolverResidual(ActiveSolver solver, const PetscBool fixed[], Vec y, Vec r, Vec f, PetscReal *size);
/* Whether a residual is at its limit: below rtol of the reference, or roundoff of y if that is small beside
   the reference. Collective. */
PetscErrorCode ActiveSolverSuffices(ActiveSolver solver, Vec y, PetscReal size, PetscReal reference,
                                    PetscBool *suffices);
/* Restricts y, r and f to the bounded unknowns. Collective. [in,out] solution - fixed, and y where fixed, are
   set */
PetscErrorCode ActiveSolverRestrict(ActiveSolver solver, Vec y, Vec r, Vec f, ActiveSolution *solution);
/* r = b - A y as if computed in twice the precision and rounded once (compensated.c). Collective. */
PetscErrorCode CompensatedResidual(Mat A, Vec b, Vec y, Vec r);
/* The failure that an error of a factorization means, NULL for none. Not collective. */
const char *ActiveSolverFailureOfFactor(MatFactorError error);

/* Projected Newton globalization with a line search on the energy (projectednewton.c). */
typedef struct {
  PetscBool  on, settled; /* active; its set did not change, so it may be the solution */
  PetscReal *y, *r, *d;   /* feasible iterate, its forces, the step [n] */
  PetscBool *fixed, *all; /* the set of the iterate; all unknowns [n] */
} ProjectedNewton;

/* Starts from the last solution, projected onto the bounds. Collective. */
PetscErrorCode ProjectedNewtonBegin(ProjectedNewton *newton, const ActiveSet *set, ActiveSolver solver,
                                    ActiveSolution *solution);
/* One step. Collective.
   [out] changed - of all ranks; [out] violation - as of ActiveSetUpdate(); solution->failure may be set */
PetscErrorCode ProjectedNewtonStep(ProjectedNewton *newton, ActiveSet *set, ActiveSolver solver,
                                   ActiveSolution *solution, PetscInt *changed, PetscReal *violation);
PetscErrorCode ProjectedNewtonEnd(ProjectedNewton *newton);

typedef enum { START_EMPTY, START_FULL, START_GAP, START_PREVIOUS, START_COUNT } PDASStart;

/* The context of the type: options, */
typedef struct {
  PetscReal c;
  PDASStart start;
  PetscBool start_set, reduce, reduce_set;
  Vec       lower, upper;                     /* NULL without bounds */
  Vec       areas;                            /* of PDASSetAreas(), or NULL */
  Vec       previous;                         /* of PDASSetStart(), or NULL */
  PetscReal error_reduction, energy_decrease; /* of PDASSetErrorReduction() */
  /* results, */
  PetscInt    max_it, iterations, linear_iterations;
  PetscInt   *changed; /* [max_it] */
  PetscInt    num_seen;
  uint64_t   *seen;   /* hashes of the solved sets [max_it] */
  PetscReal   target; /* residual at which the next system is first evaluated */
  PetscBool   converged, safeguarded, reduced;
  PetscReal   residual;   /* relative, of the last system */
  const char *failure;    /* reason of a failed system, or NULL */
  PetscInt    num_active; /* of the present set */
  Vec         active;     /* 0/1, the final set */
  /* friction, */
  const FrictionLaw *law; /* borrowed, or NULL */
  FrictionReport     friction_report;
  FrictionReport     coarser;     /* of PDASSetFrictionRho(), no nodes for none */
  PetscBool          rho_skipped; /* rho is not wanted */
  PetscBool          coupling_needed;
  PetscBool          friction_yields; /* of PDASSetFrictionYields() */
  PetscReal          friction_rtol;   /* of PDASSetFrictionTolerance() */
  PetscBool          fixed_point;     /* over Tresca problems, instead of Newton's method */
  /* and what is kept for the next solve, if matrix and bounds stay the same */
  PetscBool    keep;
  ActiveSet    set;
  ActiveSolver solver; /* NULL if there is none */
  Vec          b;
} PDAS;

/* Sets the initial active set, as iteration 0. Collective. [in] y - initial guess; [in] r - its forces b - A
   y */
PetscErrorCode PDASBegin(SNES snes, PDAS *pdas, ActiveSet *set, Vec y, Vec r);
/* Iterates until the set does not change. Sets pdas->converged, or pdas->failure, or neither after max_it
   steps. Collective. [out] y - the last solution, unless there was a failure */
PetscErrorCode PDASIterate(SNES snes, PDAS *pdas, ActiveSet *set, ActiveSolver solver, Vec y);

/* The context of a SNES of type pdas. Not collective. */
PetscErrorCode PDASGet(SNES snes, PDAS **pdas);
/* Creates pdas->solver for pdas->set, or sets pdas->failure. Collective. [in] y - initial guess */
PetscErrorCode PDASChooseSolver(SNES snes, PDAS *pdas, Mat A, Vec b, Vec y);

/* Solves systems with multigrid until |y - y*|_A^2 <= reduction (decrease + |y_0 - y*|_A^2). Collective. [in]
   decrease - of the square, before y_0 */
PetscErrorCode PDASSetErrorReduction(SNES snes, PetscReal reduction, PetscReal decrease);
/* The same for one solver. Not collective. */
PetscErrorCode ConvergenceSetErrorReduction(ActiveSolver solver, PetscReal error_reduction, PetscReal energy_decrease);

/* Whether the iteration with friction gives up early at full size, with a coefficient above 1: where steps
   leave a residual above the forces, or coefficients do not grow by the first factor. Then a dense system can
   take its place. Default: no. Collective. */
PetscErrorCode PDASSetFrictionYields(SNES snes, PetscBool yields);

/* The solver of the last solve, with its final set, if it was kept (PDASSetKeep()) and converged. Borrowed,
   NULL if there is none. Not collective. */
PetscErrorCode PDASGetSolver(SNES snes, ActiveSolver *solver);
/* A solver as pdas would choose it, or of the KSP alone for another SNES type. Collective. [out] failure -
   reason, or NULL; solver must be destroyed in any case */
PetscErrorCode PDASCreateSolver(SNES snes, const ActiveSet *set, Mat A, Vec b, PetscReal rtol, ActiveSolver *solver,
                                const char **failure);

#endif
