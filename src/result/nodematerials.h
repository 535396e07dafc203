/* nodematerials.h -- which materials meet at the nodes of bodies with regions. */
#ifndef MORTISE_NODEMATERIALS_H
#define MORTISE_NODEMATERIALS_H

#include "level/level.h"

typedef struct {
  PetscInt  most;     /* materials at one node of any rank; 1 where no body has regions */
  PetscInt *start;    /* into material [num_nodes+1]; NULL where no body has regions */
  PetscInt *material; /* of the cells at each local node, those of other ranks as well, ascending [start[num_nodes]] */
} NodeMaterials;

/* Collective. [out] at - to be freed by NodeMaterialsDestroy() */
PetscErrorCode NodeMaterialsCreate(Scene scene, Level *level, NodeMaterials *at);
PetscErrorCode NodeMaterialsDestroy(NodeMaterials *at);

/* The place of a material among those of a local node: 0 .. most-1. */
static inline PetscInt NodeMaterialsFind(const NodeMaterials *at, PetscInt node, PetscInt material)
{
  PetscInt i = 0;

  while (at->start && at->material[at->start[node] + i] != material) i++;
  return i;
}

/* How many materials meet at a local node. */
static inline PetscInt NodeMaterialsCount(const NodeMaterials *at, PetscInt node)
{
  return at->start ? at->start[node + 1] - at->start[node] : 1;
}

#endif
