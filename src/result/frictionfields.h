/* frictionfields.h -- tangential tractions and slips of pairs with friction, and what is left of the law
   (eqs. 16.1, 16.7). */
#ifndef MORTISE_FRICTIONFIELDS_H
#define MORTISE_FRICTIONFIELDS_H

#include "result/fields.h"

/* What one pair does tangentially; the same on all ranks. */
typedef struct {
  PetscReal force[3];    /* resultant of the tangential tractions that the mortar side exerts on the nonmortar body */
  PetscReal slip_share;  /* of the area in contact that slips; NAN without contact */
  PetscReal max_slip;    /* of this load step */
  PetscReal dissipation; /* sum D q.s: what friction took in this load step */
} FrictionSum;

/* What the law of friction is off by, over all pairs; dimensionless, the same on all ranks. */
typedef struct {
  PetscReal cone; /* max (|q| - G)_+ / p_ref */
  PetscReal slip; /* max ||s| q - G s| / (p_ref max |s|): a traction below G where there is slip, or not along it */
  PetscReal dissipation; /* max (-q.s)_+ / (p_ref max |s|) */
} FrictionResidual;

/* Status of the rows of pairs with friction: stick or slip where they are in contact, for the normal row and
   its tangents. Not collective. */
PetscErrorCode FrictionFieldsSetStatus(Fields fields);
/* Vectors at owned nodes of pair p. Collective.
   [out] traction - exerted by the mortar side; at removed nodes the mean of neighbours, as the pressure; 0
   off the nonmortar side [num_owned][dim];
   [out] slip - of the nonmortar side against it, in this load step; NAN without a multiplier
   [num_owned][dim] */
PetscErrorCode FrictionFieldsGet(Fields fields, PetscInt p, PetscReal traction[], PetscReal slip[]);
/* Nodes of pair p in contact whose friction is lost, because supports hold all nodes around as well.
   Collective.
   [out] num - of all ranks; [out] share - their part of the area in contact;
   [out] at - the first of them by coordinates [dim] */
PetscErrorCode FrictionFieldsFindHeld(Fields fields, PetscInt p, PetscInt *num, PetscReal *share, PetscReal at[]);
/* Collective. */
PetscErrorCode FrictionSumCompute(Fields fields, PetscInt p, FrictionSum *sum);
/* Collective. [in] tolerance - that roundoff of forces and displacements may reach */
PetscErrorCode FrictionResidualCompute(Fields fields, PetscReal tolerance, FrictionResidual *residual);

#endif
