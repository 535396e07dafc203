/* envelopefactor.h -- a PC that factors blocks, and then the rows that couple them; internal (eq. 13.4). */
#ifndef MORTISE_ENVELOPEFACTOR_H
#define MORTISE_ENVELOPEFACTOR_H

#include <petscksp.h>
#include "multigrid/envelopeparts.h"

/* S keeps its factors. From now on it changes by EnvelopeFactorScale() alone. Not collective.
   [in] S - SPD, AIJ of one process; else nothing happens; [in] bs - rows with one label; [in] label - of the
   blocks; copied [rows / bs] */
PetscErrorCode EnvelopeFactorKeep(Mat S, PetscInt bs, const PetscReal label[]);
/* The blocks of another matrix that keeps its factors, if any, are those of S too. Not collective. */
PetscErrorCode EnvelopeFactorKeepLike(Mat S, Mat other);
/* The factors that S keeps. Not collective.
   [out] parts - borrowed; NULL where there are no blocks, or a sparse factor costs less */
PetscErrorCode EnvelopeFactorGet(Mat S, EnvelopeParts **parts);
/* S has the blocks of a matrix that keeps its factors; blocks with the same rows have the same factors. Not
   collective. [in] from - referenced by S */
PetscErrorCode EnvelopeFactorSetBase(Mat S, Mat from);
/* Call it after S was multiplied by a number. Not collective. */
PetscErrorCode EnvelopeFactorScale(Mat S, PetscReal factor);
/* Makes pc the inverse of S. Not collective.
   [in] S - second operator of pc, with blocks; [out] done - false where there are no blocks, or a sparse
   factor costs less */
PetscErrorCode EnvelopeFactorSetPC(PC pc, Mat S, PetscBool *done);

#endif
