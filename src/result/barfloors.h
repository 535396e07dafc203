/* barfloors.h -- least errors of the numbers of one solution, from its own error estimate (eq. 15.5). */
#ifndef MORTISE_BARFLOORS_H
#define MORTISE_BARFLOORS_H

#include "result/estimate.h"
#include "result/frictionfloors.h"

/* Of a side with a reaction. */
typedef struct {
  PetscReal relative; /* 2 (eta_B / |u|_B)^2 of its body: of the size of the body's largest reaction */
  PetscReal least[3]; /* not relative: 2 |rest| of what shared nodes have; of a radial one also 2 eta_B^2 |z|_B /
                         |u|_B of a radial motion z */
} SideFloors;

/* Of one pair. */
typedef struct {
  PetscReal      pressure;  /* 3 max |lambda_a + n.s* n| over the facets around the node of largest pressure; with
                              friction, half the same difference along the side is added */
  PetscReal      edge[3];   /* size of the largest facet that contact ends on */
  PetscReal      area;      /* half the area of those facets */
  PetscReal      centre[3]; /* half their sizes by the parts of the force on them: centre of pressure */
  FrictionFloors friction;
} PairFloors;

/* Of the place of one probe, over its cell; not relative. */
typedef struct {
  PetscReal stress;       /* 3 max |s* - s| of each component */
  PetscReal von_mises;    /* 3 times the largest von Mises stress of s* - s */
  PetscReal principal;    /* 3 times the largest |principal stress| of s* - s */
  PetscReal displacement; /* 3/4 h max |C^-1 (s* - s)|, 3/10 of order 2 */
} ProbeFloors;

/* Relative floors are multiplied by the size of the number. */
typedef struct {
  PetscReal    whole;     /* 2 (eta / |u|)^2, and that of the potential: forces, reactions */
  PetscReal    potential; /* 2 J' (eq. 15.8), not relative: of the potential, in addition to its bar */
  PetscReal   *body;      /* 6 (eta_B / |u|_B)^2, and that of the potential: displacements and energies of a body
                             [num_bodies] */
  SideFloors  *side;      /* [boundaries of all bodies] */
  PairFloors  *pair;      /* [num_pairs] */
  ProbeFloors *probe;     /* [num_probes] */
} BarFloors;

/* Collective. [in] reactions - at nodes, of CertificateCompute(); [out] floors - to be freed by
   BarFloorsDestroy() */
PetscErrorCode BarFloorsCreate(Fields fields, Vec reactions, BarFloors *floors);
PetscErrorCode BarFloorsDestroy(BarFloors *floors);

#endif
