/* support.h -- fixed directions of each node, and their values.

   Displacement data fix Cartesian directions, normal data fix the side's normal. Both become orthonormal
   directions of each node: d_k . u = value_k, k < count. Data that contradict each other at a node are a user
   error. Nodes on the axis of an axisymmetric scene are fixed along the radius automatically. */
#ifndef MORTISE_SUPPORT_H
#define MORTISE_SUPPORT_H

#include "level/level.h"

enum {
  BOUNDARY_NONE = -1, /* free */
  BOUNDARY_AXIS = -2  /* fixed by the axis of an axisymmetric scene alone: no radial displacement */
};

/* What one boundary fixes at a node. */
typedef struct {
  PetscInt  boundary; /* within the body, BOUNDARY_AXIS where nothing else fixes the radius */
  PetscInt  count;
  PetscReal direction[3][3]; /* orthonormal [count][dim] */
} SharedSide;

/* A node that several boundaries fix. */
typedef struct {
  PetscInt          node, num;
  const SharedSide *side;      /* [num] */
  PetscBool         ambiguous; /* whether two of them fix the same direction */
} SharedNode;

typedef struct {
  PetscInt   dim;
  PetscInt  *count;      /* fixed directions of each local node, 0..dim [num_nodes] */
  PetscReal *directions; /* orthonormal, fixed ones first, completed to a frame where count > 0 [num_nodes][dim][dim] */
  PetscReal *values;     /* [num_nodes][dim] */
  PetscInt  *side; /* index of the boundary (within the body) that holds the node first, or one of these [num_nodes] */
  PetscInt   num_shared;
  SharedNode *shared;    /* by ascending local node [num_shared] */
  SharedSide *sides;     /* of all shared nodes */
  PetscReal   max_value; /* largest |value| of all ranks */
} Support;

/* Computes the fixed directions and their values. Directions along axes keep the Cartesian frame exactly.
   User errors: data that contradict each other; a side with a normal displacement that is not flat.
   Collective. */
PetscErrorCode SupportCreate(Level *level, Scene scene, Support *support);
/* Sets the values of the present time, for the same directions. Collective. */
PetscErrorCode SupportUpdate(Level *level, Scene scene, Support *support);
PetscErrorCode SupportDestroy(Support *support);
/* Splits the force of a shared node among its boundaries: f = sum_i f_i, f_i in the directions that boundary
   i fixes. The sum of |f_i - expected_i|^2 is the least. Not collective.
   [in] force - in the span of its directions [dim]; [in,out] parts - expected ones; f_i [shared->num][dim];
   [out] rests - f_i less the expected part in these directions [shared->num][dim] */
void SupportSplitForce(const Support *support, const SharedNode *shared, const PetscReal force[], PetscReal parts[],
                       PetscReal rests[]);

#endif
