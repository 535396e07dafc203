/* errorbound.h -- bound on the distance of a displacement from the solution; internal (eq. 11.2). */
#ifndef MORTISE_ERRORBOUND_H
#define MORTISE_ERRORBOUND_H

#include "solve/proximal.h"

/* The bound for any y, with the factors or the preconditioner kept by a SNES of type pdas, or with its KSP.
   Collective. [in] y - of proximal->solved; [out] bound - in the user's units; NAN with friction that follows
   the pressure */
PetscErrorCode ErrorBoundCompute(const Proximal *proximal, SNES snes, Vec y, EnergyBound *bound);

#endif
