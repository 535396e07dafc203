/* solvercontext.h -- all objects of one solve. */
#ifndef MORTISE_SOLVERCONTEXT_H
#define MORTISE_SOLVERCONTEXT_H

#include <stdbool.h>
#include "solve/solverimpl.h"
#include "solve/proximal.h"

/* An option of PETSc that has no function. */
typedef struct {
  const char *name, *value;
  bool        needed;
  PetscBool   set;       /* set here, to be cleared here */
  char        given[32]; /* of the user, to be restored */
} Default;

enum { SOLVERCONTEXT_DEFAULTS = 4 };

typedef struct {
  Solver      solver; /* borrowed */
  const char *prefix; /* of options; borrowed */
  PetscBool   keep;   /* whether the solver keeps the levels afterwards */
  Proximal    proximal;
  SNES        snes;
  PC          pc;     /* of its KSP */
  MeshLevels  levels; /* NULL without levels */
  Vec         scratch;
  PetscReal   norm;
  Default     defaults[SOLVERCONTEXT_DEFAULTS];
} SolverContext;

/* Collective. [in] previous - whether there is an initial set; [out] context - must not be moved: the SNES
   has its address */
PetscErrorCode SolverContextCreate(Solver solver, const SolverChoice *choice, PetscBool previous,
                                   SolverContext *context);
/* Sets the levels of a multigrid preconditioner, those of the last solve if it kept them. Collective. [in]
   snes - if it passes the inactive unknowns alone, or NULL */
PetscErrorCode SolverContextSetLevels(SolverContext *context, SNES snes);
/* Collective. [in,out] y - what ProximalEnd() takes */
PetscErrorCode SolverContextDestroy(SolverContext *context, Vec y);

#endif
