/* nodecoarsening.h -- a coarser level made of some nodes of a finer one, by its matrix and their places; internal (eq. 13.6). */
#ifndef MORTISE_NODECOARSENING_H
#define MORTISE_NODECOARSENING_H

#include "base/compat.h"
#include <petscmat.h>

/* What a node may take from: the vertices of a cell, where nodes on edges and in the middle of cells take from these. */
enum { NODE_TERMS = 8 };

/* What each node of a level takes from which others, itself alone where it is on the coarser level, by global numbers. Empty where this is to
   be found out: count is NULL. */
typedef struct {
  PetscInt  *count;  /* [nodes of this rank] */
  PetscInt  *from;   /* [nodes of this rank][NODE_TERMS] */
  PetscReal *weight; /* [nodes of this rank][NODE_TERMS] */
} NodeTable;

typedef struct {
  Mat        A;     /* AIJ; borrowed */
  PetscInt   dim;   /* unknowns of a node, and coordinates */
  PetscReal *x;     /* places [nodes of this rank][dim] */
  PetscBool *fixed; /* unknowns that stay where they are [unknowns of this rank] */
  /* as in NodeTable */
  PetscInt  *count;  /* [nodes of this rank] */
  PetscInt  *from;   /* nodes of all ranks [nodes of this rank][NODE_TERMS] */
  PetscReal *weight; /* [nodes of this rank][NODE_TERMS] */
} NodeSet;

PetscErrorCode NodeCoarseningDestroy(NodeSet *nodes);

/* P gives every node, unless it is told what to take, the linear function of a few chosen ones near it, but for held unknowns, from and to which
   nothing leads. Nodes that no others give a linear function to are chosen. Collective. [out] P - owned by the caller; [out] coarse - all but A */
PetscErrorCode NodeCoarseningApply(const NodeSet *nodes, Mat *P, NodeSet *coarse);

#endif
