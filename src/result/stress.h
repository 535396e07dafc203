/* stress.h -- stresses at nodes. */
#ifndef MORTISE_STRESS_H
#define MORTISE_STRESS_H

#include "result/nodematerials.h"

/* A node where regions of a body meet has a stress in each of them. */
typedef struct {
  NodeMaterials at;
  Vec *
      value; /* ghosted, 6 per node, xx,yy,zz,yz,xz,xy: value[i] in the cells of a node's i-th material, 0 where it has fewer [at.most] */
} NodalStress;

/* Stresses of the displacement u at nodes (eq. 8.2). Collective. [in] u - ghosted, dim per node; [out] stress - to be freed by
   NodalStressDestroy() */
PetscErrorCode StressCreate(Scene scene, Level *level, Vec u, NodalStress *stress);
PetscErrorCode NodalStressDestroy(NodalStress *stress);

#endif
