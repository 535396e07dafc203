/* support.h -- fixed directions of each node, and their values.

   Displacement data hold Cartesian directions, normal data hold the side's normal. Both become orthonormal
   directions per node: d_k . u = value_k, k < count. Data that contradict each other at a node are a user error. Nodes on the axis of an
   axisymmetric scene are fixed along the radius without being told. */
#ifndef MORTISE_SUPPORT_H
#define MORTISE_SUPPORT_H

#include "mesh/mesh.h"

enum {
  BOUNDARY_NONE = -1, /* free */
  BOUNDARY_AXIS = -2  /* fixed by the axis of an axisymmetric scene alone: no radial displacement */
};

typedef struct {
  PetscInt   dim;
  PetscInt  *count;      /* fixed directions of each local node, 0..dim [num_nodes] */
  PetscReal *directions; /* orthonormal, fixed ones first, completed to a frame where count > 0 [num_nodes][dim][dim] */
  PetscReal *values;     /* [num_nodes][dim] */
  PetscInt  *side; /* index of the boundary (within the body) that holds the node first, or one of these [num_nodes] */
  PetscReal  max_value; /* largest |value| of all ranks */
} Support;

/* Collective. Axis-aligned directions keep the Cartesian frame exactly. */
PetscErrorCode SupportCreate(Level *level, Scene scene, Support *support);
/* The values of the present time, for the same directions. Collective. */
PetscErrorCode SupportUpdate(Level *level, Scene scene, Support *support);
PetscErrorCode SupportDestroy(Support *support);

#endif
