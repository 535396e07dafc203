/* support.h -- fixed directions of each node, and their values.

   Displacement data hold Cartesian directions, normal data hold the side's normal. Both become orthonormal
   directions per node: d_k . u = value_k, k < count. Data that contradict each other at a node are a user
   error. Nodes on the axis of an axisymmetric scene are fixed along the radius without being told. */
#ifndef MORTISE_SUPPORT_H
#define MORTISE_SUPPORT_H

#include "mesh/mesh.h"

enum {
  BOUNDARY_NONE = -1, /* free */
  BOUNDARY_AXIS = -2  /* fixed by the axis of an axisymmetric scene alone: no radial displacement */
};

/* A node that several boundaries fix: each direction as its boundary gives it, orthogonal to the others or not. */
typedef struct {
  PetscInt  node;
  PetscInt  side[3];         /* boundaries within the body, BOUNDARY_AXIS [count] */
  PetscReal direction[3][3]; /* unit, independent [count][dim] */
} SharedNode;

typedef struct {
  PetscInt   dim;
  PetscInt  *count;      /* fixed directions of each local node, 0..dim [num_nodes] */
  PetscReal *directions; /* orthonormal, fixed ones first, completed to a frame where count > 0 [num_nodes][dim][dim] */
  PetscReal *values;     /* [num_nodes][dim] */
  PetscInt  *side; /* index of the boundary (within the body) that holds the node first, or one of these [num_nodes] */
  PetscInt   num_shared;
  SharedNode *shared;    /* by ascending local node [num_shared] */
  PetscReal   max_value; /* largest |value| of all ranks */
} Support;

/* Collective. Axis-aligned directions keep the Cartesian frame exactly. */
PetscErrorCode SupportCreate(Level *level, Scene scene, Support *support);
/* The values of the present time, for the same directions. Collective. */
PetscErrorCode SupportUpdate(Level *level, Scene scene, Support *support);
PetscErrorCode SupportDestroy(Support *support);
/* Splits the force of a shared node among its boundaries: f = sum_k c_k d_k. [in] force - in the span of its
   directions [dim];
   [out] parts - c_k [support->count] */
void SupportSplitForce(const Support *support, const SharedNode *shared, const PetscReal force[], PetscReal parts[]);

#endif
