/* mglevel.h -- one level of truncated multigrid; internal (eq. 13.3). */
#ifndef MORTISE_MGLEVEL_H
#define MORTISE_MGLEVEL_H

#include "multigrid/hierarchy.h"

/* A level with some unknowns fixed: active ones, and those that its operator fixes. */
typedef struct {
  Hierarchy       hierarchy; /* borrowed */
  HierarchyLevel *base;      /* borrowed */
  Mat             change;    /* the change of A by truncation on finer levels, on the finest by the caller; or NULL */
  Vec             free;      /* M: 1 where free, 0 where fixed */
  Vec             W;         /* on the diagonal of A, or NULL; borrowed */
  PetscBool       ready;     /* whether MGLevelSetFree() was called */
  PetscInt        num;       /* fixed unknowns of this rank */
  PetscInt        num_truncated;    /* of these, not fixed by the operator */
  PetscInt       *fixed;            /* counted from this rank's first [num] */
  Vec             diag;             /* of A + change, of A where fixed */
  Vec             wave, wave_force; /* v and Q'r of waves (eq. 13.9), or NULL */
  Mat             A;                /* A^, a shell; on the coarsest level a matrix */
  Mat             P;                /* M P, a shell */
  Mat             S;                /* the smoother's, or NULL */
  PetscReal       largest;          /* upper bound on the eigenvalues of S^-1 A^ */
} MGLevel;

/* [in] hierarchy - borrowed; [in] l - level. Collective. */
PetscErrorCode MGLevelCreate(Hierarchy hierarchy, PetscInt l, MGLevel *level);
PetscErrorCode MGLevelDestroy(MGLevel *level);

/* Sets the free unknowns of the finest level, and from there of all coarser ones. Only changes since the last
   call cost work. Collective.
   [in,out] levels - coarse first [num];
   [in] free - of the finest: 1 where free, 0 where fixed; [in] more - what is added to A there, few entries,
   or NULL */
PetscErrorCode MGLevelSetFree(PetscInt num, MGLevel levels[], Vec free, Mat more);
/* A^ of the coarsest level as a matrix. Collective. */
PetscErrorCode MGLevelAssemble(MGLevel *level);
/* The preconditioner of the smoother: of S, or the diagonal, in the region if there is one. Collective.
   [in] level - borrowed by pc */
PetscErrorCode MGLevelSetPC(MGLevel *level, PC pc);
/* A^ as the operator of an iteration: for vectors that are 0 where active and arbitrary where the operator
   fixes unknowns. Collective. [out] A - owned by the caller, not to outlive the level */
PetscErrorCode MGLevelCreateOperator(MGLevel *level, Mat *A);

#endif
