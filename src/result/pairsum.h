/* pairsum.h -- force, area, extent and centre of pressure of one pair. */
#ifndef MORTISE_PAIRSUM_H
#define MORTISE_PAIRSUM_H

#include "result/fields.h"

/* The same on all ranks; NAN where there is nothing to measure. */
typedef struct {
  PetscReal force[3];     /* what the mortar side exerts on the nonmortar body */
  PetscReal normal_force; /* integral of the pressure */
  PetscReal area;         /* where the pressure is positive */
  PetscReal max_pressure, max_pressure_at[3];
  PetscInt  max_pressure_row; /* its row among those of all ranks; -1 without one */
  PetscReal
      max_covered; /* the largest where PairSumEndsPartner() is false: others are extrapolated from a part of a facet */
  PetscReal min_gap;
  PetscReal lower[3], upper[3]; /* box around the active nodes */
  PetscReal centre[3];          /* of pressure */
  PetscReal
           moment_imbalance; /* of the pair's forces on both sides, over the sum of their sizes; NAN with an obstacle */
  PetscInt active;           /* nodes in contact, or tied */
} PairSum;

/* All NAN: of a pair nothing is known of. */
PairSum PairSumUnknown(void);
/* Whether the partner ends within a facet around multiplier node a, and not where its own side does. */
PetscBool PairSumEndsPartner(const Pair pair, PetscInt a);
/* The sums of pair p. Collective. [out] sum - the same on all ranks */
PetscErrorCode PairSumCompute(Fields fields, PetscInt p, PairSum *sum);

#endif
