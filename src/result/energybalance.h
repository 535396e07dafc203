/* energybalance.h -- energy balance of a load step with friction (eq. 16.9). */
#ifndef MORTISE_ENERGYBALANCE_H
#define MORTISE_ENERGYBALANCE_H

#include "result/fields.h"

/* The end of a load step. */
typedef struct {
  PetscBool rest;      /* in place of the rest: the bodies before all loads */
  Vec       u, force;  /* displacement; loads and reactions at nodes [N]; NULL where nothing is known */
  Vec       lambda, G; /* of all rows; NULL without any */
  PetscReal stored;    /* strain energy of all bodies */
  PetscReal elastic;   /* u'K u / 2: the same without eigenstrains */
} EnergyState;

/* Of one load step, the same on all ranks; NAN where nothing is known of its begin. */
typedef struct {
  PetscReal
      work; /* of loads, supports, temperatures and gaps that change, by the mean of their forces before and after */
  PetscReal stored;      /* change of the strain energy */
  PetscReal dissipation; /* by friction, with its tractions at the end of the step */
  PetscReal defect;      /* work - stored - dissipation: of second order in the step */
} EnergyBalance;

/* Balances a step from its begin to the present fields, which become the begin of the next one. Collective.
   [in] reactions - as of CertificateCompute(); [in,out] state; [out] balance */
PetscErrorCode EnergyBalanceAdvance(Fields fields, Vec reactions, EnergyState *state, EnergyBalance *balance);
/* Nothing is known any more. Collective. */
PetscErrorCode EnergyStateForget(EnergyState *state);

#endif
