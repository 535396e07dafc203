/* symmetricblocks.h -- a symmetric matrix in square blocks, of which those on and right of the diagonal are stored. */
#ifndef MORTISE_SYMMETRICBLOCKS_H
#define MORTISE_SYMMETRICBLOCKS_H

#include <petscsys.h>

enum { SYMMETRIC_BLOCKS_MAX = 3 }; /* size of a block, at least 2 */

typedef struct {
  PetscInt     bs, num;
  PetscInt    *start, *column; /* blocks of every row, stored or not, ascending [num+1], [start[num]] */
  PetscInt    *diagonal;       /* which of them is on the diagonal [num] */
  PetscInt    *first;          /* its place in value; the rest of the row follows [num+1] */
  PetscScalar *value;          /* [first[num]][bs][bs] */
} SymmetricBlocks;

/* Zeros. Not collective. [in] start, column - each row has its own block and those whose rows have one in this column, ascending; taken over */
PetscErrorCode SymmetricBlocksCreate(PetscInt bs, PetscInt num, PetscInt start[], PetscInt column[],
                                     SymmetricBlocks *blocks);
PetscErrorCode SymmetricBlocksDestroy(SymmetricBlocks *blocks);
/* The stored block of row i and column j >= i, [bs][bs]. Both must couple. */
PetscScalar *SymmetricBlocksAt(const SymmetricBlocks *blocks, PetscInt i, PetscInt j);
/* Writes row i out, both triangles. [out] rows - [bs][width] from the first column on that is asked for; [in] width - of a row */
void SymmetricBlocksGetRow(const SymmetricBlocks *blocks, PetscInt i, PetscInt width, PetscScalar rows[]);
/* y = factor V x for these blocks V. */
void SymmetricBlocksMult(const SymmetricBlocks *blocks, PetscReal factor, const PetscScalar x[], PetscScalar y[]);

#endif
