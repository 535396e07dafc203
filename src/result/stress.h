/* stress.h -- stresses at nodes. */
#ifndef MORTISE_STRESS_H
#define MORTISE_STRESS_H

#include "result/nodematerials.h"

/* A node where regions of a body meet has a stress in each of them. */
typedef struct {
  NodeMaterials at;
  Vec *
      value; /* ghosted, xx,yy,zz,yz,xz,xy per node: value[i] in cells of its i-th material, 0 if it has fewer [at.most] */
} NodalStress;

/* Stresses of the displacement u at nodes (eq. 8.2). Collective. [in] u - ghosted, dim per node; [out] stress
   - to be freed by NodalStressDestroy() */
PetscErrorCode StressCreate(Scene scene, Level *level, Vec u, NodalStress *stress);
PetscErrorCode NodalStressDestroy(NodalStress *stress);

/* Stresses at local nodes while they are read. */
typedef struct {
  const NodeMaterials *at;
  Vec                 *local;
  const PetscScalar  **value; /* [at->most][num_nodes][6] */
} NodalStressArrays;

/* Not collective. [out] arrays - to be given back by NodalStressRestoreArrays() before the stress changes */
PetscErrorCode NodalStressGetArrays(const NodalStress *stress, NodalStressArrays *arrays);
PetscErrorCode NodalStressRestoreArrays(const NodalStress *stress, NodalStressArrays *arrays);

/* The stress at a local node in the cells of a material, level->cell_material, that are there [6]. */
static inline const PetscScalar *NodalStressAt(const NodalStressArrays *arrays, PetscInt node, PetscInt material)
{
  return &arrays->value[NodeMaterialsFind(arrays->at, node, material)][node * 6];
}

#endif
