/* wavesolve.h -- the small system of waves; internal (eq. 13.9). */
#ifndef MORTISE_WAVESOLVE_H
#define MORTISE_WAVESOLVE_H

#include <petscksp.h>
#include "multigrid/operator.h"

/* A factorization of Q'A Q, Q = op->waves. Collective. [out] solve - owned by the caller */
PetscErrorCode WaveSolveCreate(const Operator *op, PC *solve);

#endif
