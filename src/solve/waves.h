/* waves.h -- displacements of alternating sign, the slowest errors of cells that keep their volume; internal
   (eq. 13.9). */
#ifndef MORTISE_WAVES_H
#define MORTISE_WAVES_H

#include "level/level.h"
#include "multigrid/operator.h"

/* Waves on a level of the mesh with cells of order 1. Collective.
   [in] op - of that level, with tight nodes; [in] P - node values of the next coarser level to those of each
   one [l + 1]; [in] l - the level, not the coarsest; [out] waves - y of each wave, owned by the caller */
PetscErrorCode WavesCreate(const Operator *op, Level *level, const Mat P[], PetscInt l, Mat *waves);

#endif
