/* solvercontext.h -- all objects of one solve. */
#ifndef MORTISE_SOLVERCONTEXT_H
#define MORTISE_SOLVERCONTEXT_H

#include <stdbool.h>
#include "solve/solverimpl.h"
#include "solve/proximal.h"

/* An option of PETSc that has no function. */
typedef struct {
  const char *name, *value;
  bool        needed, forced; /* forced: in place of the user's */
  PetscBool   set;            /* set here, to be cleared here */
  char        given[32];      /* of the user, to be restored */
} Default;

enum { SOLVERCONTEXT_DEFAULTS = 6 };

struct _n_SolverContext {
  Solver       solver; /* borrowed */
  SolverChoice choice;
  const char  *prefix; /* of options; borrowed */
  PetscBool    keep;   /* whether the solver keeps the levels afterwards */
  PetscBool    used;   /* whether it has solved */
  Proximal     proximal;
  SNES         snes;
  PC           pc;     /* of its KSP */
  MeshLevels   levels; /* NULL without levels */
  Vec          scratch;
  PetscReal    norm;
  Default      defaults[SOLVERCONTEXT_DEFAULTS];
};
typedef struct _n_SolverContext SolverContext;

/* Collective. [in] previous - whether there is an initial set; [out] context - must not be moved: the SNES
   has its address */
PetscErrorCode SolverContextCreate(Solver solver, const SolverChoice *choice, PetscBool previous,
                                   SolverContext *context);
/* A new one as for a solution, with levels. Collective. [in] report - of it, or NULL for any y; [out] context
   - as above */
PetscErrorCode SolverCreateContext(Solver solver, const SolverReport *report, SolverContext *context);
/* y without the rigid motion that SolverSolve() adds. Collective.
   [out] own - to be destroyed by the caller */
PetscErrorCode SolverSubtractRigid(Solvability solvability, Vec y, Vec *own);
/* Sets the levels of a multigrid preconditioner, those of the last solve if it kept them. Collective. [in]
   snes - if it passes the inactive unknowns alone, or NULL */
PetscErrorCode SolverContextSetLevels(SolverContext *context, SNES snes);
/* The context that the solver has kept, if it is of that choice, or a new one. Collective. [out] context - to
   be given back by SolverContextReturn() */
PetscErrorCode SolverContextTake(Solver solver, const SolverChoice *choice, PetscBool previous,
                                 SolverContext **context);
/* Lets the solver keep the context for its next solve, or destroys it. Collective. [in] keep - whether it has
   solved what it was for;
   [in,out] y - what ProximalEnd() takes */
PetscErrorCode SolverContextReturn(SolverContext **context, PetscBool keep, Vec y);
/* Destroys what the solver has kept. Collective. */
PetscErrorCode SolverContextForget(Solver solver);
/* Collective. [in,out] y - what ProximalEnd() takes */
PetscErrorCode SolverContextDestroy(SolverContext *context, Vec y);

#endif
