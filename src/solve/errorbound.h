/* errorbound.h -- how far a displacement can be from the solution of the inequality; internal (eq. 11.2). */
#ifndef MORTISE_ERRORBOUND_H
#define MORTISE_ERRORBOUND_H

#include "solve/proximal.h"

/* Of any y, with the factors or the preconditioner that a SNES of type pdas kept, or with its KSP. Collective.
   [in] y - of what was solved, springs->solved; [out] bound - in the user's units */
PetscErrorCode ErrorBoundCompute(const Proximal *proximal, SNES snes, Vec y, EnergyBound *bound);

#endif
