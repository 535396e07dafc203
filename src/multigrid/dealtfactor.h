/* dealtfactor.h -- a PC on several ranks: each solves for whole blocks of rows; internal (eq. 13.4). */
#ifndef MORTISE_DEALTFACTOR_H
#define MORTISE_DEALTFACTOR_H

#include <petscksp.h>

/* Sets the type of a PC of one process, which has operators. */
typedef PetscErrorCode (*DealtFactorConfigure)(PC inner);

/* Makes pc the inverse of S, block by block. PCSetUp() is then the work of each rank for itself. Collective.
   [in] S - second operator of pc, AIJ; [in] configure - for the rows of this rank, called by PCSetUp() */
PetscErrorCode DealtFactorSetPC(PC pc, Mat S, DealtFactorConfigure configure);
/* Whether pc was made so. Not collective. */
PetscErrorCode DealtFactorIs(PC pc, PetscBool *dealt);
/* Call it after S was multiplied by a number. Not collective. */
PetscErrorCode DealtFactorScale(Mat S, PetscReal factor);

#endif
