/* setupcheck.h -- what a scene is before it is solved: bodies, sides, pairs and loads as numbers (-check). */
#ifndef MORTISE_SETUPCHECK_H
#define MORTISE_SETUPCHECK_H

#include "result/largest.h"
#include "rigid/solvability.h"

typedef struct {
  PetscInt  cells, nodes, pieces;
  PetscInt  motions;            /* rigid motions that its supports leave */
  PetscReal volume;             /* area times thickness in a plane, of the whole ring where axisymmetric */
  PetscReal lower[3], upper[3]; /* box around its nodes */
  Largest   shape;  /* least scaled Jacobian of a corner: 1 right or equilateral, 0 flat; NAN without cells */
  Largest   aspect; /* largest ratio of two edges of a cell */
  PetscReal force[3], moment[3]; /* of all loads, moment about the origin; in a plane moment[2], axisymmetric none */
} SetupBody;

/* What a side is named for, as bits. */
enum {
  ROLE_DISPLACEMENT = 1,
  ROLE_NORMAL       = 2,
  ROLE_TRACTION     = 4,
  ROLE_PRESSURE     = 8,
  ROLE_FORCE        = 16,
  ROLE_MOMENT       = 32,
  ROLE_NONMORTAR    = 64,
  ROLE_MORTAR       = 128
};

typedef struct {
  PetscInt    body;
  const char *side; /* as typed, of the scene */
  int         roles;
  PetscInt    facets;
  PetscReal   area; /* with the thickness, of the whole ring */
  PetscReal   normal[3],
      centre[3]; /* mean outward normal, not a unit vector where the side bends or has corners; mean point */
} SetupSide;

typedef struct {
  PetscInt  nodes, facing, multipliers; /* of the nonmortar side; with a partner within reach; with a multiplier */
  Largest   least, largest;             /* nodal gaps before any motion */
  PetscReal reach;
} SetupPair;

typedef struct {
  PetscInt   num_sides;
  SetupBody *bodies; /* [scene->num_bodies] */
  SetupSide *sides;  /* by body, in the order typed: supports, loads, pairs [num_sides] */
  SetupPair *pairs;  /* [vi->num_pairs] */
} SetupCheck;

/* Volume of a cell as that of a body. Not collective. */
PetscReal SetupCellVolume(Scene scene, const Level *level, PetscInt c);
/* The same on all ranks. Collective. [out] check - to be freed by SetupCheckDestroy() */
PetscErrorCode SetupCheckCompute(VI vi, SetupCheck *check);
PetscErrorCode SetupCheckDestroy(SetupCheck *check);
/* For each node that this rank owns the sum of 2^s over the sides s < 30 whose facets have it. Collective.
   [out] bits - [num_owned], owned by the caller */
PetscErrorCode SetupCheckMarkNodes(VI vi, const SetupCheck *check, PetscReal **bits);

#endif
