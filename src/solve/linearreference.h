/* linearreference.h -- the cost of the last linear system alone. */
#ifndef MORTISE_LINEARREFERENCE_H
#define MORTISE_LINEARREFERENCE_H

#include "pdas/pdasimpl.h"
#include "solve/proximal.h"

/* Solves the system of the active set of y from zero to a relative residual of 1e-8, with the configured KSP.
   Collective. [in] y - of proximal->solved.vi; [out] iterations - of the KSP; [out] solved */
PetscErrorCode LinearReferenceSolve(const Proximal *proximal, SNES snes, Vec y, PetscInt *iterations,
                                    PetscBool *solved);
/* The set of a solution by eq. 10.1. Collective. [in] y - of vi; [in,out] set - of ActiveSetCreate() */
PetscErrorCode LinearReferenceSetActive(VI vi, Vec y, ActiveSet *set);

#endif
