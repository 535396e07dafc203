/* mglevel.h -- one level of truncated multigrid; internal (eq. 13.3). */
#ifndef MORTISE_MGLEVEL_H
#define MORTISE_MGLEVEL_H

#include "multigrid/hierarchy.h"

/* One level with some of its unknowns held. */
typedef struct {
  Hierarchy       hierarchy;     /* borrowed */
  HierarchyLevel *base;          /* borrowed */
  Mat             change;        /* what truncation on finer levels adds to A, or NULL */
  Vec             free;          /* M: 1 where free, 0 where held */
  Vec             W;             /* on the diagonal of A, or NULL; borrowed */
  PetscBool       ready;         /* whether MGLevelSetFree() was here before */
  PetscInt        num;           /* held unknowns of this rank */
  PetscInt        num_truncated; /* of these, not eliminated before */
  PetscInt       *fixed;         /* counted from this rank's first [num] */
  Vec             diag;          /* of A + change, of A where held */
  Mat             A;             /* A^, a shell; on the coarsest level a matrix */
  Mat             P;             /* M P, a shell */
  Mat             S;             /* the smoother's, or NULL */
  PetscReal       largest;       /* eigenvalue of S^-1 A^ at least */
} MGLevel;

/* [in] hierarchy - borrowed; [in] l - level. Collective. */
PetscErrorCode MGLevelCreate(Hierarchy hierarchy, PetscInt l, MGLevel *level);
PetscErrorCode MGLevelDestroy(MGLevel *level);

/* Which unknowns are held, on the finest level and from there on all coarser ones; only what has changed since the last time is worked
   on. Collective. [in,out] rungs - coarse first [num]; [in] free - of the finest: 1 where free, 0 where held */
PetscErrorCode MGLevelSetFree(PetscInt num, MGLevel levels[], Vec free);
/* A^ of the coarsest level as a matrix. Collective. */
PetscErrorCode MGLevelAssemble(MGLevel *level);
/* A^ for vectors that are 0 where active, whatever they are where unknowns were eliminated before: to iterate with. Collective.
   [out] A - owned by the caller, not to outlive the rung */
PetscErrorCode MGLevelCreateOperator(MGLevel *level, Mat *A);

#endif
