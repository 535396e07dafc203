/* envelopefactor.h -- a PC that factors blocks, and then the rows that couple them; internal (eq. 13.4). */
#ifndef MORTISE_ENVELOPEFACTOR_H
#define MORTISE_ENVELOPEFACTOR_H

#include <petscksp.h>
#include "multigrid/envelopeparts.h"

/* S keeps its factors, or on several ranks its labels alone. From now on it changes by EnvelopeFactorScale()
   alone. Not collective.
   [in] S - SPD, AIJ; [in] bs - rows with one label; [in] label - of the blocks: the number of one of their
   rows, divided by bs; copied [rows of this rank / bs] */
PetscErrorCode EnvelopeFactorKeep(Mat S, PetscInt bs, const PetscReal label[]);
/* The blocks of another matrix that keeps its factors, if any, are those of S too. Not collective. */
PetscErrorCode EnvelopeFactorKeepLike(Mat S, Mat other);
/* A matrix of some rows of S keeps its factors, with the blocks of S or of its base, if they have any.
   Collective.
   [in] S - on several ranks; [in] rows - of this rank; [in] own - of one process, its rows and columns are
   these */
PetscErrorCode EnvelopeFactorKeepRows(Mat S, IS rows, Mat own);
/* Whole blocks of S, each on one rank. Collective.
   [in] S - on several ranks, with labels, in which nothing couples two blocks; [out] rows - ascending;
   [out] own - of these rows, keeps its factors; both owned by the caller */
PetscErrorCode EnvelopeFactorDeal(Mat S, IS *rows, Mat *own);
/* The factors that S keeps. Not collective.
   [in] S - of one process; [out] parts - borrowed; NULL where there are no blocks, or a sparse factor
   costs less */
PetscErrorCode EnvelopeFactorGet(Mat S, EnvelopeParts **parts);
/* S has the blocks of a matrix that keeps its factors; blocks with the same rows have the same factors. Not
   collective. [in] from - referenced by S */
PetscErrorCode EnvelopeFactorSetBase(Mat S, Mat from);
/* The matrix whose blocks S has. Not collective. [out] base - borrowed; S itself if it keeps its own, NULL
   where there are no blocks */
PetscErrorCode EnvelopeFactorGetBase(Mat S, Mat *base);
/* Call it after S was multiplied by a number. Not collective. */
PetscErrorCode EnvelopeFactorScale(Mat S, PetscReal factor);
/* Makes pc the inverse of S. Not collective.
   [in] S - second operator of pc, with blocks; [out] done - false where there are no blocks, or a sparse
   factor costs less */
PetscErrorCode EnvelopeFactorSetPC(PC pc, Mat S, PetscBool *done);

#endif
