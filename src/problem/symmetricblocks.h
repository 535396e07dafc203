/* symmetricblocks.h -- a symmetric matrix in square blocks, of which those on and right of the diagonal are
   stored. */
#ifndef MORTISE_SYMMETRICBLOCKS_H
#define MORTISE_SYMMETRICBLOCKS_H

#include <petscsys.h>

enum { SYMMETRIC_BLOCKS_MAX = 3 }; /* size of a block, at least 2 */

typedef struct {
  PetscInt     bs, num;        /* size of a block, number of rows of blocks */
  PetscInt    *start, *column; /* blocks of every row, stored or not, ascending [num+1], [start[num]] */
  PetscInt    *diagonal;       /* index into column of the diagonal block [num] */
  PetscInt    *first;          /* index into value of the diagonal block; the blocks right of it follow [num] */
  PetscInt     num_values;     /* blocks that are stored */
  PetscInt     num_ordered;    /* of these, in the order of the rows; later ones belong to rows that have grown */
  PetscScalar *value;          /* [num_values][bs][bs] */
} SymmetricBlocks;

/* Some of the rows, ascending. */
typedef struct {
  PetscInt num, *row; /* [num] */
} BlockRows;

/* Creates a matrix of zeros. Not collective.
   [in] start, column - blocks of every row, on both sides of the diagonal, ascending; owned by blocks from
   now on
   [out] blocks - owned by the caller, SymmetricBlocksDestroy() */
PetscErrorCode SymmetricBlocksCreate(PetscInt bs, PetscInt num, PetscInt start[], PetscInt column[],
                                     SymmetricBlocks *blocks);
/* Takes the first rows of other blocks, without copies of their numbers. Not collective.
   [in] start, column - as above, for `num` rows; [in] kept - rows that have the blocks they had; the others
   are zeros [num]; [in,out] from - these rows keep their numbers, which blocks owns: set from->value to NULL
   before it is destroyed; [out] blocks - owned by the caller */
PetscErrorCode SymmetricBlocksCreateWithin(PetscInt num, PetscInt start[], PetscInt column[], const PetscBool kept[],
                                           SymmetricBlocks *from, SymmetricBlocks *blocks);
/* Not collective. */
PetscErrorCode SymmetricBlocksDestroy(SymmetricBlocks *blocks);
/* Stores equal rows of numbers once: from now on they are not to be changed. Not collective. */
PetscErrorCode SymmetricBlocksShare(SymmetricBlocks *blocks);
/* The stored block of row i and column j >= i, which must be in the pattern. Not collective. Borrowed
   [bs][bs] */
PetscScalar *SymmetricBlocksAt(const SymmetricBlocks *blocks, PetscInt i, PetscInt j);
/* Copies row i with all of its blocks. Not collective. [in] width - distance of two rows of numbers in rows;
   [out] rows - [bs][width] */
void SymmetricBlocksGetRow(const SymmetricBlocks *blocks, PetscInt i, PetscInt width, PetscScalar rows[]);
/* y = factor V x for these blocks V. Not collective. [in] x, [out] y - [num][bs] */
void SymmetricBlocksMult(const SymmetricBlocks *blocks, PetscReal factor, const PetscScalar x[], PetscScalar y[]);
/* factor V in single precision. Not collective. [out] single - owned by the caller, PetscFree() */
PetscErrorCode SymmetricBlocksCreateSingle(const SymmetricBlocks *blocks, PetscReal factor, float **single);
/* y = (factor V) x, of these numbers, in double precision. Not collective. [in] x, [out] y - [num][bs] */
void SymmetricBlocksMultSingle(const SymmetricBlocks *blocks, const float single[], const PetscScalar x[],
                               PetscScalar y[]);
/* The same of some rows: each with its blocks on and right of the diagonal, and these transposed. y is V x
   where all blocks of a row that meet an x which is not zero are in these rows or columns. Not collective.
   [in] single - as above, already times factor; or NULL */
void SymmetricBlocksMultRows(const SymmetricBlocks *blocks, const BlockRows *rows, PetscReal factor,
                             const float single[], const PetscScalar x[], PetscScalar y[]);
/* The same products without AVX2: for the unit test. */
void SymmetricBlocksMultPortably(const SymmetricBlocks *blocks, PetscReal factor, const PetscScalar x[],
                                 PetscScalar y[]);
void SymmetricBlocksMultSinglePortably(const SymmetricBlocks *blocks, const float single[], const PetscScalar x[],
                                       PetscScalar y[]);

#endif
