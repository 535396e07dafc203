/* solverimpl.h -- what the files of this room share beside active.h. */
#ifndef MORTISE_SOLVERIMPL_H
#define MORTISE_SOLVERIMPL_H

#include "solve/meshlevels.h"
#include "solve/solver.h"

struct _n_Solver {
  VI          vi;          /* borrowed */
  Solvability solvability; /* borrowed; NULL where supports hold all bodies */
  MeshLevels  levels;      /* kept from the last solve for the next one, or NULL */
};

/* How an inequality is to be solved. */
typedef struct {
  char        snes[64], ksp[64], pc[64]; /* types; what the options database says of ksp and pc still comes on top */
  char        why[160];                  /* where the choice of the linear solver comes from */
  const char *prefix;                    /* of options; "" for the user's */
  PetscBool   nearly;                    /* whether some body is so nearly incompressible that iterating takes long */
  PetscBool   nested;                    /* whether there are coarser meshes to begin on */
  PetscBool   stop;                      /* whether at the discretisation error (eq. 14.7) */
  PetscBool   bound;                     /* whether the energy of the error is to be bounded */
  PetscBool   own;                       /* whether the linear solver is nobody's wish */
  PetscInt    max_it;                    /* iterations at most, where that is more than usual */
  PetscBool   yields;                    /* whether it gives way to a factorisation that would have cost less */
  PetscBool   keep;                      /* whether the solver keeps the multigrid levels for the next solve */
} SolverChoice;

/* The linear solver in words. Not collective. [in] package - that factors, or NULL; [out] words - shape [len] */
PetscErrorCode SolverChoiceDescribe(const char ksp[], const char pc[], const char package[], char words[], size_t len);
/* Whether a PC factors its matrix. Not collective. */
PetscBool SolverChoiceFactors(const char pc[]);

/* From -snes_type, -ksp_type, -pc_type; by size where they are silent. Faults on types that cannot. Collective. */
PetscErrorCode SolverChoiceSet(Solver solver, SolverChoice *choice);

/* The other one of pdas and vinewtonrsls: with multigrid if the first used it, else, and whatever that was, with a factorisation; with
   500 iterations, or twice those of the first.
   Collective. [in] prefix - of its options, which may say otherwise */
PetscErrorCode SolverChoiceSetSecond(VI vi, const SolverReport *first, const char prefix[], SolverChoice *choice);

/* A factorisation where an iteration has failed that nobody asked for, and a warning that says so. Collective.
   [out] again - whether there is something else to try */
PetscErrorCode SolverChoiceSetFallback(const SolverReport *report, SolverChoice *choice, PetscBool *again);

/* A SNES as the choice and the options want it. Collective. [in] solved, scratch, norm - for its function and its test; must outlive it; [out] snes */
PetscErrorCode SNESSetupCreate(const Inequality *solved, const SolverChoice *choice, Vec scratch, PetscReal *norm,
                               SNES *snes);

/* Solves with a SNES of its own. Collective.
   [in] progress - whether to print the table; [in] guess - displacement, or NULL; [out] y - created by the caller;
   [out] report */
PetscErrorCode SolverRun(Solver solver, const SolverChoice *choice, PetscBool progress, Vec guess, Vec y,
                         SolverReport *report);
/* Where SolverRun() begins. Collective. [in] snes - of the choice, multigrid not yet bound to it; [in] guess - displacement, or NULL; [out] y */
PetscErrorCode InitialGuessSet(const Inequality *solved, Solvability solvability, const SolverChoice *choice, SNES snes,
                               Vec guess, Vec y);

/* Prints one line per iteration on the first rank, from now to SNESDestroy(). Collective. [in] solved - borrowed until then */
PetscErrorCode ProgressSet(SNES snes, const Inequality *solved);
/* Whether the scene and the terminal ask for that. Collective. */
PetscErrorCode ProgressWanted(Scene scene, PetscBool *wanted);

/* Adds what a SNES did to what it did before. Collective. [in] solved, y - its problem and solution; [in,out] report */
PetscErrorCode SolverReportAdd(SNES snes, const Inequality *solved, Vec y, SolverReport *report);
/* What of a solution touches its bounds. Collective. [out] active - unknowns at their bound with a force on them;
   [out] residual - of all others, relative as in active.h */
PetscErrorCode SolverReportMeasure(const Inequality *solved, Vec y, PetscInt *active, PetscReal *residual);

#endif
