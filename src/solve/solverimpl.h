/* solverimpl.h -- what the files of this module share. */
#ifndef MORTISE_SOLVERIMPL_H
#define MORTISE_SOLVERIMPL_H

#include "solve/meshlevels.h"
#include "solve/solver.h"

/* How to solve an inequality. */
typedef struct {
  char        snes[64], ksp[64], pc[64]; /* types; what the options database says of ksp and pc still comes on top */
  char        why[160];                  /* reason of the choice of the linear solver */
  const char *prefix;                    /* of options; "" for the user's */
  PetscBool   nearly;                    /* whether a body is so nearly incompressible that iterations take long */
  PetscBool   nested;                    /* whether there are coarser meshes for nested iteration */
  PetscBool   stop;                      /* whether at the discretisation error (eq. 14.7) */
  PetscBool   bound;                     /* whether to compute the error bound */
  PetscBool   own;                       /* whether the linear solver is a default, not the user's */
  PetscInt    max_it;                    /* largest number of iterations, if larger than usual */
  PetscBool   yields;                    /* whether a cheaper factorization may replace it */
  PetscBool   keep;                      /* whether the solver keeps the multigrid levels for the next solve */
  PetscBool   replaces;                  /* whether it replaces one that failed, the user's, too */
  PetscBool   reducible;                 /* with friction at full size: whether its dense system could be solved */
  PetscBool   stalls;                    /* and whether it is early, with a large coefficient */
  PetscBool   fixed_point;               /* with friction: over Tresca's, for the second solution */
  PetscBool   again;                     /* whether it keeps everything, for the same matrices at another time */
} SolverChoice;

struct _n_Solver {
  VI                       vi;          /* borrowed */
  Solvability              solvability; /* borrowed; NULL where supports hold all bodies */
  MeshLevels               levels;      /* kept from the last solve for the next one, or NULL */
  MeshLevels               older;       /* those of a solver on the mesh before it got one more level, or NULL */
  Vec                      left;        /* active set of an iteration that cost too much, or NULL */
  PetscBool                extended;    /* whether the next initial guess is prolonged from a coarser mesh */
  struct _n_SolverContext *context;     /* all of the last solve, kept for the next one, or NULL */
  PetscBool                chosen;      /* whether the choice is that of all solves; */
  PetscBool                gave_way;    /* and whether it has replaced another one */
  SolverChoice             choice;
};

/* The linear solver in words. Not collective.
   [in] package - that factors, or NULL; [out] words - shape [len] */
PetscErrorCode SolverChoiceDescribe(const char ksp[], const char pc[], const char package[], char words[], size_t len);
/* Whether a PC is a factorization. Not collective. */
PetscBool SolverChoiceFactors(const char pc[]);

/* Chooses by -snes_type, -ksp_type, -pc_type, and by size without them. User errors for unsuitable types.
   Collective. */
PetscErrorCode SolverChoiceSet(Solver solver, SolverChoice *choice);

/* Chooses the second solver: the other of pdas and vinewtonrsls, with multigrid if the first used it, else
   with a factorization; with 500 iterations, or twice those of the first. Collective. [in] prefix - of its
   options, which have priority */
PetscErrorCode SolverChoiceSetSecond(VI vi, const SolverReport *first, const char prefix[], SolverChoice *choice);

/* Chooses a factorization if a default iteration has failed, and warns. Collective. [out] again - whether
   there is such a choice */
PetscErrorCode SolverChoiceSetFallback(const SolverReport *report, SolverChoice *choice, PetscBool *again);

/* Creates a SNES by the choice and the options. Collective. [in] solved, scratch, norm - for its function and
   its test; must outlive it; [out] snes */
PetscErrorCode SNESSetupCreate(const Inequality *solved, const SolverChoice *choice, Vec scratch, PetscReal *norm,
                               SNES *snes);

/* A line search that lowers the energy 1/2 y'A y - b'y along projected steps. Collective.
   [in] ctx - the Inequality */
PetscErrorCode EnergySearchApply(SNESLineSearch search, void *ctx);

/* Solves with a SNES of its own. Collective.
   [in] progress - whether to print the table;
   [in] guess - displacement, or NULL; [out] y - created by the caller;
   [out] report */
PetscErrorCode SolverRun(Solver solver, const SolverChoice *choice, PetscBool progress, Vec guess, Vec y,
                         SolverReport *report);
/* The initial guess of SolverRun(). Collective. [in] snes - of the choice, without multigrid levels; [in]
   guess - displacement, or NULL; [out] y */
PetscErrorCode InitialGuessSet(const Inequality *solved, Solvability solvability, const SolverChoice *choice, SNES snes,
                               Vec guess, Vec y);

/* Prints one line per iteration on the first rank, from now to SNESDestroy(). Collective. [in] solved -
   borrowed until then */
PetscErrorCode ProgressSet(SNES snes, const Inequality *solved);
/* Whether the scene and the terminal want this table. Collective. */
PetscErrorCode ProgressWanted(Scene scene, PetscBool *wanted);

/* Adds the results of a SNES to the report. Collective. [in] solved, y - its problem and solution; [in,out]
   report */
PetscErrorCode SolverReportAdd(SNES snes, const Inequality *solved, Vec y, SolverReport *report);
/* Counts active unknowns. Collective. [out] active - unknowns at their bound with a force; [out] residual -
   of the free rows, relative as ActiveSolution.eta */
PetscErrorCode SolverReportMeasure(const Inequality *solved, Vec y, PetscInt *active, PetscReal *residual);

#endif
