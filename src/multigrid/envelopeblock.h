/* envelopeblock.h -- the Cholesky factor of one block of a matrix, within its envelope. */
#ifndef MORTISE_ENVELOPEBLOCK_H
#define MORTISE_ENVELOPEBLOCK_H

#include <petscsys.h>

enum { ENVELOPE_TILE = 4 }; /* rows and columns of a tile */

/* Rows of L in tiles. A panel has the tiles of ENVELOPE_TILE rows, from the first one that is not 0 to the
   diagonal one. Of this it has the inverse. Edges are rows of another block that couple to this one: their
   panels have the columns of this block alone. Panels are filled up by rows of the identity, or of zeros. */
typedef struct {
  PetscInt   references;
  PetscInt   num, panels;           /* rows of the block, without edges */
  PetscInt   num_edges, all_panels; /* panels of the block and of its edges */
  PetscInt  *row;                   /* rows of the matrix in the order of the factor, then edges [num + num_edges] */
  PetscInt  *first;                 /* first tile of each panel, counted from the left [all_panels] */
  size_t    *start;                 /* index of it [all_panels + 1] */
  float     *fp32;                  /* in single precision, or NULL [start[all_panels]][ENVELOPE_TILE][ENVELOPE_TILE] */
  PetscReal *fp64;                  /* or in double precision */
} EnvelopeBlock;

/* A symmetric matrix by rows, of one process. */
typedef struct {
  PetscInt         n;
  const PetscInt  *start, *column;
  const PetscReal *value;
} EnvelopeRows;

/* Not collective.
   [in] row - in the order of the factor, then edges [num + num_edges]; [in] left - place of the leftmost
   column in the block, num of an edge without one [num + num_edges]; [out] block - without numbers; owned by
   the caller */
PetscErrorCode EnvelopeBlockCreate(PetscInt num, PetscInt num_edges, const PetscInt row[], const PetscInt left[],
                                   EnvelopeBlock **block);
/* The same without numbers. Not collective. [out] copy - owned by the caller */
PetscErrorCode EnvelopeBlockDuplicate(const EnvelopeBlock *block, EnvelopeBlock **copy);
/* Returns a reference. */
PetscErrorCode EnvelopeBlockDestroy(EnvelopeBlock **block);
/* The work of the factorization: the sum of the squares of the widths of its rows. */
PetscReal EnvelopeBlockWork(const EnvelopeBlock *block);
/* The entries of factor A. Not collective.
   [in] place - of rows in the order of the block, negative elsewhere [A->n]; [out] tiles - owned by the
   caller, of EnvelopeBlockFactor() */
PetscErrorCode EnvelopeBlockGather(const EnvelopeRows *A, PetscReal factor, const PetscInt place[],
                                   const EnvelopeBlock *block, PetscReal **tiles);
/* Subtracts what elimination of a block adds to its edges. Not collective.
   [in] place - of edges in the order of `edges`, negative where they are fixed;
   [in,out] tiles - of `edges` */
void EnvelopeBlockEliminate(const EnvelopeBlock *block, const PetscInt place[], const EnvelopeBlock *edges,
                            PetscReal tiles[]);
/* The factor. Not collective.
   [in] exact - whether it is kept in double precision in any case; [in,out] tiles - taken over */
PetscErrorCode EnvelopeBlockFactor(PetscBool exact, PetscReal **tiles, EnvelopeBlock *block);
/* x := L^-1 x. Not collective. [in,out] x - [ENVELOPE_TILE panels], then [out] products with edges, to be
   subtracted there [ENVELOPE_TILE all_panels] */
void EnvelopeBlockForward(const EnvelopeBlock *block, PetscReal x[]);
/* x := L'^-1 x. Not collective. [in,out] x - of the block, then [in] of its edges */
void EnvelopeBlockBackward(const EnvelopeBlock *block, PetscReal x[]);

#endif
