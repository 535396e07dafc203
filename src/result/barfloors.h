/* barfloors.h -- least errors of the numbers of one solution, from its own error estimate (eq. 15.5). */
#ifndef MORTISE_BARFLOORS_H
#define MORTISE_BARFLOORS_H

#include "result/estimate.h"
#include "result/frictionfloors.h"

/* Of one pair. */
typedef struct {
  PetscReal      pressure; /* 3 max |lambda_a + n.s* n| over the facets around the node of largest pressure; with
                              friction, half the same difference along the side is added */
  PetscReal      edge;     /* size of the largest facet that contact ends on */
  PetscReal      area;     /* half the area of those facets */
  FrictionFloors friction;
} PairFloors;

/* Relative floors are multiplied by the size of the number. */
typedef struct {
  PetscReal   whole;  /* 2 (eta / |u|)^2: forces, reactions */
  PetscReal  *body;   /* 6 (eta_B / |u|_B)^2: displacements and energies of a body [num_bodies] */
  PetscReal  *side;   /* 2 (eta_B / |u|_B)^2: reactions of a body's sides, of the largest one's size [num_bodies] */
  PetscReal  *ring;   /* 2 eta_B^2 |z|_B / |u|_B of a radial motion z: radial reactions, not relative [num_bodies] */
  PairFloors *pair;   /* [num_pairs] */
  PetscReal  *stress; /* 3 max |s* - s| over the cell of each probe [num_probes] */
  PetscReal  *place;  /* 3/4 h max |C^-1 (s* - s)| there, 3/10 of order 2: displacements, not relative [num_probes] */
} BarFloors;

/* Collective. [out] floors - to be freed by BarFloorsDestroy() */
PetscErrorCode BarFloorsCreate(Fields fields, BarFloors *floors);
PetscErrorCode BarFloorsDestroy(BarFloors *floors);

#endif
