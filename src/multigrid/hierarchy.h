/* hierarchy.h -- one inequality on all levels of its mesh, and what leads from one to the next; internal (eq. 13.3). */
#ifndef MORTISE_HIERARCHY_H
#define MORTISE_HIERARCHY_H

#include "problem/vi.h"
#include "multigrid/iterationcost.h"
#include "multigrid/smoother.h"

/* One level. */
typedef struct {
  VI  vi; /* owned but for the finest */
  Mat A;  /* vi->A, borrowed */
  Mat P; /* y of the next coarser level to y of this one, nothing from and to eliminated unknowns; NULL on the coarsest */
  Vec lift;   /* what comes to this level from eliminated unknowns of the coarser one; NULL where they are 0 */
  Vec weight; /* how much of this level each unknown of the next coarser one moves: squares of P's columns; NULL like P */
  Vec       diag;    /* of A */
  Mat       S;       /* the smoother's, or NULL where that is the diagonal */
  PetscReal largest; /* eigenvalue of S^-1 A at least; 0 on the coarsest */
  PetscReal share;   /* entries of A by those of the finest: what a product costs */
  Vec       springs; /* what is in A beside the bodies' stiffness, on its diagonal; borrowed, or NULL */
} Grid;

typedef struct {
  PetscInt  num;
  PetscInt  first; /* the coarsest level that has a mesh */
  Grid     *grid;  /* coarse first */
  PetscReal work;  /* products with A so far, in products with the finest one */
  PetscReal
      change; /* |u_2h - u_4h|_K^2, of the finest two levels below the finest, in the user's units; 0 where it is not known */
  Patience patience;
} * Hierarchy;

/* Whether levels' matrices are nearly those of prolongation: not where volumes change by whole cells (eq. 9.1). Collective. */
PetscErrorCode HierarchyIsNested(VI vi, PetscBool *nested);
/* All levels of vi->mesh, and where the coarsest has many unknowns, or is the only one, levels below it (algebraic.h). The finest is vi
   itself. Collective. [in] springs - on the diagonal of vi->A, or NULL */
PetscErrorCode HierarchyCreate(VI vi, Vec springs, Hierarchy *hierarchy);
/* Whether there is one or not. Collective. */
PetscErrorCode HierarchyDestroy(Hierarchy *hierarchy);

/* Whether all that was done on the levels is too much beside a factorisation. Collective. */
PetscErrorCode HierarchyIsOver(Hierarchy hierarchy, PetscBool *over);

#endif
