/* frictionlaw.h -- friction of the pairs as a law for the unknowns y of a VI (eq. 16.1). */
#ifndef MORTISE_FRICTIONLAW_H
#define MORTISE_FRICTIONLAW_H

#include "problem/vi.h"

/* Evaluates coefficients and bounds of all pairs at their nodes, in the scales of vi; vi->friction, NULL
   where no node has friction. Raises a user error for a negative one. Collective. */
PetscErrorCode FrictionLawCreate(VI vi);
/* The same for other data, scales, or another origin. Collective. */
PetscErrorCode FrictionLawUpdate(VI vi);
/* Position of a node in the law, whose order is not that of rows; -1 where it has no friction.
   Not collective. [in] normal - global number of its normal unknown */
PetscInt FrictionLawFind(const FrictionLaw *law, PetscInt normal);
/* Whether limits are given at all nodes of all ranks (Tresca), and none depends on a pressure: a convex
   problem. Collective. */
PetscErrorCode FrictionLawIsGiven(VI vi, PetscBool *given);
PetscErrorCode FrictionLawDestroy(FrictionLaw **law);
/* The law for y counted from another vector. Collective. [in] approach - NULL for none */
PetscErrorCode FrictionLawSetApproach(VI vi, Vec approach);

#endif
