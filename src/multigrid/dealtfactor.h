/* dealtfactor.h -- a PC on several ranks: each solves for whole blocks of rows; internal (eq. 13.4). */
#ifndef MORTISE_DEALTFACTOR_H
#define MORTISE_DEALTFACTOR_H

#include <petscksp.h>

/* Makes pc the inverse of S, block by block. Collective.
   [in] S - second operator of pc, AIJ; [out] inner - of the rows of this rank, with operators, borrowed: its
   type is to be set */
PetscErrorCode DealtFactorSetPC(PC pc, Mat S, PC *inner);
/* Whether pc was made so. Not collective. */
PetscErrorCode DealtFactorIs(PC pc, PetscBool *dealt);
/* Call it after S was multiplied by a number. Not collective. */
PetscErrorCode DealtFactorScale(Mat S, PetscReal factor);

#endif
