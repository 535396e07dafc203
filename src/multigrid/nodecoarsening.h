/* nodecoarsening.h -- node-based coarsening: a coarser level made of some nodes of a finer one; internal (eq.
   13.6). */
#ifndef MORTISE_NODECOARSENING_H
#define MORTISE_NODECOARSENING_H

#include "base/compat.h"
#include <petscmat.h>

/* Most nodes that a node interpolates from: the vertices of a cell. */
enum { NODE_TERMS = 8 };

/* Interpolation that is known beforehand, by global numbers: the coarse nodes that each node interpolates
   from, itself alone if it is one. count is NULL if nothing is known. */
typedef struct {
  PetscInt  *count;  /* [nodes of this rank] */
  PetscInt  *from;   /* [nodes of this rank][NODE_TERMS] */
  PetscReal *weight; /* [nodes of this rank][NODE_TERMS] */
} NodeTable;

typedef struct {
  Mat        A;     /* AIJ */
  PetscInt   dim;   /* unknowns of a node, and coordinates */
  PetscReal *x;     /* positions [nodes of this rank][dim] */
  PetscBool *fixed; /* fixed displacements [unknowns of this rank] */
  /* as in NodeTable */
  PetscInt  *count;  /* [nodes of this rank] */
  PetscInt  *from;   /* nodes of all ranks [nodes of this rank][NODE_TERMS] */
  PetscReal *weight; /* [nodes of this rank][NODE_TERMS] */
} NodeSet;

PetscErrorCode NodeCoarseningDestroy(NodeSet *nodes);

/* Prolongation P: every node takes the linear interpolation of a few coarse nodes, by NodeTable or found
   here. Fixed unknowns are neither source nor target. A node that cannot be interpolated becomes a coarse
   node. Collective. [out] P - owned by the caller; [out] coarse - all but A */
PetscErrorCode NodeCoarseningApply(const NodeSet *nodes, Mat *P, NodeSet *coarse);

#endif
