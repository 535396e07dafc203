/* envelopeparts.h -- the Cholesky factor of a matrix in blocks that few rows couple. */
#ifndef MORTISE_ENVELOPEPARTS_H
#define MORTISE_ENVELOPEPARTS_H

#include "multigrid/envelopeblock.h"

/* Rows that couple to rows with another label are edges. The other rows are blocks: what entries connect. */
typedef struct {
  PetscInt        references;
  PetscReal       scale; /* of the matrix relative to that with these factors */
  PetscInt        num;
  EnvelopeBlock **block;             /* [num] */
  EnvelopeBlock  *edges;             /* all edges */
  PetscInt       *of;                /* block of each row; negative for edges and rows without others [n] */
  PetscInt       *place;             /* of each row in `edges`, or -1 [n] */
  PetscInt        num_alone, *alone; /* rows without others [num_alone] */
  PetscReal      *inverse;           /* [num_alone] */
  size_t         *start;             /* of each block in work, then of the edges [num + 1] */
  PetscReal      *work;              /* of EnvelopePartsSolve() */
} EnvelopeParts;

/* Not collective.
   [in] bs - rows with one label; [in] label - [A->n / bs]; [in] base, from - another matrix and its factors,
   which are used again for blocks with the same rows, or NULL; [out] parts - new blocks without numbers;
   owned by the caller */
PetscErrorCode EnvelopePartsCreate(const EnvelopeRows *A, PetscInt bs, const PetscReal label[],
                                   const EnvelopeRows *base, const EnvelopeParts *from, EnvelopeParts **parts);
/* Returns a reference. */
PetscErrorCode EnvelopePartsDestroy(EnvelopeParts **parts);
/* The work of a factorization from nothing: the sum of the squares of the widths of all rows. */
PetscReal EnvelopePartsWork(const EnvelopeParts *parts);
/* The numbers. Not collective. */
PetscErrorCode EnvelopePartsFactor(const EnvelopeRows *A, EnvelopeParts *parts);
/* The matrix is multiplied by a number. */
void EnvelopePartsScale(PetscReal factor, EnvelopeParts *parts);
/* z = A^-1 r. Not collective. [in] r, [out] z - [A->n] */
void EnvelopePartsSolve(const EnvelopeParts *parts, const PetscReal r[], PetscReal z[]);
/* The same in some blocks without edges, and in rows without others. Not collective.
   [in] which - blocks [num]; [in] r, [in,out] z - [A->n] */
void EnvelopePartsSolveSome(const EnvelopeParts *parts, PetscInt num, const PetscInt which[], const PetscReal r[],
                            PetscReal z[]);

#endif
