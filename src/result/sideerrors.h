/* sideerrors.h -- what is not known of a file's curved sides, as an error of pressures (eq. 15.8). */
#ifndef MORTISE_SIDEERRORS_H
#define MORTISE_SIDEERRORS_H

#include "result/fields.h"

/* All 0 where the sides are known, or do not touch; the same on all ranks. */
typedef struct _n_SideErrors {
  PetscReal normal;    /* error of the normals of both sides in contact, in radians, in the mean square */
  PetscReal pressure;  /* of the pressure, in the mean square */
  PetscReal mean;      /* mean pressure */
  PetscReal largest;   /* error of the pressure where it is largest */
  PetscReal at[3];     /* this place */
  PetscReal potential; /* of the potential: that of int p d g */
} SideErrors;

/* Of pair p, from the curves of its sides (level->normal_errors). The fields keep those of all pairs.
   Collective. */
PetscErrorCode SideErrorsGet(Fields fields, PetscInt p, SideErrors *errors);

#endif
