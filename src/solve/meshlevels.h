/* meshlevels.h -- the inequalities of coarser meshes, and multigrid on them; internal (eq. 13.3). */
#ifndef MORTISE_MESHLEVELS_H
#define MORTISE_MESHLEVELS_H

#include "multigrid/hierarchy.h"
#include "problem/vi.h"
#include "solve/costmodel.h"

/* What is solved: the inequality of vi, or the same with a proximal term. All borrowed. */
typedef struct {
  VI  vi;
  Mat A;
  Vec b, upper;
} Inequality;

typedef struct _n_MeshLevels {
  PetscInt  num;        /* levels of the mesh that are used */
  PetscInt *of;         /* which ones, the coarsest and the finest among them [num] */
  VI       *vi;         /* coarse first; the finest one borrowed, unless it is owned [num] */
  PetscBool own_finest; /* whether it is: between meshes */
  Mat      *P;          /* node values of the next coarser one to those of this one; NULL on the coarsest [num] */
  Vec      *lift;       /* contribution of fixed unknowns of the coarser level to free ones of this; NULL if 0 [num] */
  Hierarchy hierarchy;  /* its level hierarchy->first is that of vi[0] */
  CostModel cost;
  PetscReal change; /* |u_2h - u_4h|_K^2 of the two levels below the finest, in the user's units; 0 if unknown */
} * MeshLevels;

/* Whether the matrix of each coarser level is the Galerkin product: not with mean dilatation over cells (eq.
   9.1). Collective. */
PetscErrorCode MeshLevelsAreNested(VI vi, PetscBool *nested);
/* All levels of the mesh, of adapted meshes some; and where the coarsest has many unknowns, or is the only
   one, levels of nodes below it.
   Collective. [in] W - what A has on its diagonal beside that of vi, or NULL; [in,out] older - levels of the
   same mesh when it had one less, which own their finest one: they are consumed; or NULL; [out] levels -
   owned by the caller */
PetscErrorCode MeshLevelsCreate(const Inequality *finest, Vec W, MeshLevels *older, MeshLevels *levels);
/* Whether there are any or not. Collective. */
PetscErrorCode MeshLevelsDestroy(MeshLevels *levels);
/* What is solved on a level from now on. Not collective.
   [in] l - of these levels; [in] W - as of MeshLevelsCreate() */
PetscErrorCode MeshLevelsSetInequality(MeshLevels levels, PetscInt l, const Inequality *inequality, Vec W);

/* The matrices and masks of an inequality, with T^-1. Collective.
   [out] op - to be released by OperatorDestroy() */
PetscErrorCode MeshLevelsCreateOperator(const Inequality *inequality, Vec W, Operator *op);

#endif
