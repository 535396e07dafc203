/* hierarchy.h -- one inequality on several levels, and the prolongations between them; internal
   (eq. 13.3). */
#ifndef MORTISE_HIERARCHY_H
#define MORTISE_HIERARCHY_H

#include <petscksp.h>
#include "multigrid/nodecoarsening.h"
#include "multigrid/operator.h"

/* One level. */
typedef struct {
  Operator  op;
  PetscBool nodes; /* made of nodes of a finer level (nodelevels.h) */
  Mat P; /* y of the next coarser level to y of this one, nothing from and to fixed unknowns; NULL on the coarsest */
  Vec weight;        /* sums of the squares of the columns of P; NULL like P */
  Vec diag;          /* of A */
  Mat S;             /* the smoother's, or NULL where that is the diagonal */
  PetscReal largest; /* upper bound on the eigenvalues of S^-1 A; 0 on the coarsest */
  PetscReal share;   /* entries of A over those of the finest: the cost of a product */
  Vec       region;  /* not 0 at nodes that are smoothed: with op.halvings those whose shape functions the next coarser
                        level has not; NULL for all */
  PC        wave_solve; /* with waves' A waves of op.waves; NULL without */
  PetscReal part;       /* of the entries of A that op.S reads; 1, unless it is restricted to the region */
} HierarchyLevel;

typedef struct _n_Hierarchy {
  PetscInt        num;
  PetscInt        first;       /* the coarsest level that was given */
  HierarchyLevel *level;       /* coarse first */
  PetscReal       work;        /* products with A so far, in products with the finest one */
  PetscInt        num_systems; /* of active sets so far, of all levels */
  PetscBool       bisected;    /* as of HierarchyInput */
  PetscErrorCode (*is_over)(void *ctx, PetscReal left, PetscBool *over); /* of HierarchySetCostTest(), or NULL */
  void *ctx;
} * Hierarchy;

/* The levels that are given, coarse first. */
typedef struct {
  PetscInt  num;
  Operator *op; /* with A, b, upper and inverse, the finest of them last [num]; taken over */
  Mat      *P;  /* NULL on the coarsest [num]; taken over */
  PetscBool
      below; /* whether levels of nodes are made below the coarsest one; if not its A is AIJ and is factored, without S */
  NodeTable table;    /* of the coarsest one, for the first level below it; taken over */
  PetscBool parts;    /* whether cells are equal parts of those of the level below, with their moduli */
  PetscBool round;    /* whether no cell of the level below is long; of HierarchyCreate() */
  PetscBool lines;    /* whether cells may be long in whole lines or planes of nodes */
  PetscBool bisected; /* whether they are bisected simplices: then blocks are of use beside stiff sides alone */
} HierarchyInput;

/* Whether a coarsest level of that many unknowns is not to be factored. Not collective. */
PetscBool HierarchyIsLarge(PetscInt dim, PetscInt unknowns);
/* Collective. [in,out] input; [out] hierarchy - owned by the caller */
PetscErrorCode HierarchyCreate(HierarchyInput *input, Hierarchy *hierarchy);
/* Appends a level; the others keep matrices, smoothers, eigenvalues and transfers. For meshes of several
   levels. Collective.
   [in] drop - whether the present finest level is removed; [in] renew - whether its A has changed: it gets
   another smoother; [in] op, P - of the new level, from the one below it; taken over */
PetscErrorCode HierarchyExtend(Hierarchy hierarchy, PetscBool drop, PetscBool renew, const Operator *op, Mat P);
/* NULL is accepted. Collective. */
PetscErrorCode HierarchyDestroy(Hierarchy *hierarchy);

/* Sets the test that ends an iteration which costs too much. Not collective.
   [in] is_over - collective, or NULL; [in] ctx - borrowed */
PetscErrorCode HierarchySetCostTest(Hierarchy hierarchy, PetscErrorCode (*is_over)(void *, PetscReal, PetscBool *),
                                    void     *ctx);
/* The result of that test; false without one. Collective.
   [in] left - products until the solution is expected, or PETSC_MAX_REAL */
PetscErrorCode HierarchyIsOver(Hierarchy hierarchy, PetscReal left, PetscBool *over);

#endif
