/* solvercontext.h -- all that solving an inequality takes. */
#ifndef MORTISE_SOLVERCONTEXT_H
#define MORTISE_SOLVERCONTEXT_H

#include <stdbool.h>
#include "solve/solverimpl.h"
#include "solve/proximal.h"

/* A control that can only be reached through the options database. */
typedef struct {
  const char *name, *value;
  bool        needed;
  PetscBool   set;       /* by us, so to be cleared by us */
  char        given[32]; /* by the user, so to be put back, whatever it has been in between */
} Default;

enum { SOLVERCONTEXT_DEFAULTS = 4 };

typedef struct {
  Solver      solver; /* borrowed */
  const char *prefix; /* of options; borrowed */
  PetscBool   keep;   /* whether the solver keeps the levels afterwards */
  Proximal    proximal;
  SNES        snes;
  PC          pc;     /* of its KSP */
  MeshLevels  levels; /* NULL where there are no levels, or nobody works on them */
  Vec         scratch;
  PetscReal   norm;
  Default     defaults[SOLVERCONTEXT_DEFAULTS];
} SolverContext;

/* Collective. [in] previous - whether there is a set to begin with; [out] bench - not to be moved: the SNES knows where it is */
PetscErrorCode SolverContextCreate(Solver solver, const SolverChoice *choice, PetscBool previous,
                                   SolverContext *context);
/* The levels that the preconditioner works on, if it does; those that the solve before has kept if there are any. Collective.
   [in] snes - that leaves it the free unknowns alone, or NULL */
PetscErrorCode SolverContextSetLevels(SolverContext *context, SNES snes);
/* Collective. [in,out] y - what ProximalEnd() takes */
PetscErrorCode SolverContextDestroy(SolverContext *context, Vec y);

#endif
