/* nodebases.h -- unknowns of the nodes of contact and of oblique supports. */
#ifndef MORTISE_NODEBASES_H
#define MORTISE_NODEBASES_H

#include "problem/couplings.h"

/* Nodes whose unknowns are not the Cartesian displacements: those with multipliers or a held direction that
   is not an axis. Row r of F takes u~ to the node's r-th unknown before the mortar side is subtracted: v = F
   u~. */
typedef struct {
  PetscInt   num;
  PetscInt  *node;     /* local, owned, ascending [num] */
  PetscReal *F, *Finv; /* [num][dim][dim] */
  PetscInt  *of_node;  /* position in the list of every owned node, -1 for ordinary ones [num_owned] */
} NodeBases;

/* Collects bases and numbers the rows of B (vi->row_*). Not collective but for the level's sizes. */
PetscErrorCode NodeBasesCreate(VI vi, NodeBases *bases);
PetscErrorCode NodeBasesDestroy(NodeBases *bases);

#endif
